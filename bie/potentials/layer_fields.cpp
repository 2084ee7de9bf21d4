#include "bie/potentials/layer_fields.hpp"

#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

LayerFields make_layer_fields(const Matrix& position, const LayerDensities& densities) {
  require_size("position (Cartesian components)", position.cols(), 3);
  const Index n = n_coefficients(order_of(position.rows()));
  LayerFields fields;
  NodeColumns& columns = fields.columns;
  fields.coefficients = position;
  const auto append = [&](const char* what, const Matrix& density) {
    require_size(what, density.rows(), n);
    const Index first = fields.coefficients.cols();
    fields.coefficients.conservativeResize(n, first + density.cols());
    fields.coefficients.rightCols(density.cols()) = density;
    return static_cast<int>(first);
  };
  if (densities.laplace_single.size() > 0) {
    fields.single = append("density of the Laplace single layer", densities.laplace_single);
    columns.single = columns.count++;
    columns.single_gradient = densities.gradients;
  }
  columns.plain = densities.plain;
  if (densities.laplace_double.size() > 0) {
    fields.double_layer = append("density of the Laplace double layer", densities.laplace_double);
    columns.double_layer = columns.count++;
    if (densities.gradients) {
      columns.double_1 = columns.count++;
      columns.double_2 = columns.count++;
    }
  }
  if (densities.stokes_single.size() > 0) {
    require_size("density of the Stokes single layer (Cartesian components)", densities.stokes_single.cols(), 3);
    fields.stokes = append("density of the Stokes single layer", densities.stokes_single);
    columns.stokes = columns.count;
    columns.count += 3;
  }
  if (densities.stokes_double.size() > 0) {
    require_size("density of the Stokes double layer (Cartesian components)", densities.stokes_double.cols(), 3);
    fields.stokes_double = append("density of the Stokes double layer", densities.stokes_double);
    columns.stokes_double = columns.count;
    columns.count += 3;
  }
  return fields;
}

}  // namespace vehd

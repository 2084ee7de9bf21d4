#include "bie/bench/assembly_arithmetic.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "bie/potentials/operator_blocks.hpp"
#include "bie/potentials/target_sweep.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

double product(double rows, double inner, double columns) { return 2.0 * rows * inner * columns; }

/// Operations of the Wigner rotation of these columns of coefficients, or of its adjoint.
double rotation(int order, int azimuthal_order, const FourierColumns& columns, const std::array<bool, 2>& degrees) {
  const auto cosines = static_cast<double>(columns.cosine.size());
  const auto sines = static_cast<double>(columns.sine.size());
  double operations = 0.0;
  for (int n = 0; n <= order; ++n) {
    if (!degrees[n % 2]) continue;
    const int m = std::min(n, azimuthal_order);
    operations += product(n + 1, m + 1, cosines) + product(n, m, sines);
  }
  return operations;
}

/// Operations of Legendre sums on a hemisphere of the rotated grid, or of their adjoint; columns of cosines or sines.
double legendre_sums(const RotatedQuadrature& quadrature, double columns, const std::array<bool, 2>& degrees) {
  const double hemisphere = (quadrature.n_theta + 1) / 2;
  double operations = 0.0;
  for (int m = 0; m <= quadrature.order; ++m) {
    for (int n = m; n <= quadrature.order; ++n) {
      if (degrees[n % 2]) operations += product(hemisphere, 1.0, columns);
    }
  }
  return operations;
}

/// Operations of the azimuthal sums, even and odd orders separately on a quarter of the circle, or of their adjoint.
double fourier_sums(const RotatedQuadrature& quadrature, double columns, double n_latitudes) {
  const double quarter = quadrature.n_phi / 4;
  return product(quarter, quadrature.order + 1, n_latitudes * columns);
}

/// Operations of the kernel values at one node.
double kernel_values(const KernelColumns& kernels) {
  constexpr double kDistance = 10.0, kAreaVector = 14.0, kArea = 7.0;
  constexpr double kSingle = 2.0, kDouble = 5.0, kAdjoint = 10.0, kStokeslet = 26.0, kStresslet = 24.0;
  constexpr double kHypersingular = 31.0;
  double operations = kDistance;
  if (kernels.single >= 0) operations += kSingle;
  if (kernels.double_layer >= 0) operations += kAreaVector + kDouble;
  if (kernels.adjoint >= 0) operations += kAdjoint;
  if (kernels.stokes >= 0) operations += kStokeslet;
  if (kernels.stokes_double >= 0) operations += kAreaVector + kStresslet;
  if (kernels.hypersingular >= 0) operations += kAreaVector + kHypersingular;
  if (kernels.plain) operations += kAreaVector + kArea + kernels.count;
  return operations;
}

/// Operations from kernel rows to the matrices of the operators, over longitudes and then over latitudes.
double analysis(const TargetSweep& sweep, const SphereTransform& transform, const SymmetrySubspace& subspace,
                bool turned) {
  const SphereGrid& grid = transform.grid();
  const double n_latitudes = sweep.n_latitudes();
  const int azimuthal_order = transform.azimuthal_order();
  double operations = 0.0;
  if (!subspace.symmetry().any()) {
    const KernelColumns& kernels = sweep.kernels();
    const auto n_active = static_cast<double>(sweep.active().count());
    operations = n_latitudes * product(2 * azimuthal_order + 1, grid.n_phi / 4 + 1, kernels.count * n_active);
    // Symmetric Stokes blocks need only densities of at most the degree n of the result.
    const double n_symmetric = kernels.has_symmetric_stokes() ? SymmetricBlocks::kBlocks : 0.0;
    double n_up_to = 0.0;
    for (int n = 0; n <= transform.order(); ++n) {
      const double n_orders = 2 * std::min(n, azimuthal_order) + 1;
      n_up_to += n_orders;
      operations += product(n_symmetric * n_up_to + (kernels.count - n_symmetric) * n_active, grid.n_theta, n_orders);
    }
    return operations;
  }
  const double n_targets = turned ? grid.n_phi : static_cast<double>(sweep.images().originals().size());
  for (const OperatorBlock& block : symmetric_layout(sweep.kernels(), subspace, azimuthal_order).blocks) {
    std::set<int> orders;
    for (const Index i : block.out) orders.insert(order_of_index(i));
    const auto columns = static_cast<double>(block.n_columns());
    operations += n_latitudes * product(static_cast<double>(orders.size()), n_targets, columns);
    operations += product(columns, n_latitudes, static_cast<double>(block.out.size()));
  }
  return operations;
}

}  // namespace

double operations_per_assembly(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                               const LayerSelection& selection, const SymmetrySubspace& subspace, int fold) {
  const KernelColumns kernels(selection);
  if (kernels.count == 0) return 0.0;
  const int order = quadrature.order;
  const int azimuthal_order = transform.azimuthal_order();
  const Matrix any_shape = Matrix::Zero(n_coefficients(order), 3);
  const TargetSweep sweep(quadrature, transform, any_shape, selection, subspace.symmetry().reflections, fold);
  const bool mirrored = sweep.images().in_mirror();
  const DegreeParities degrees = degree_parities(kernels, subspace, fold > 1);
  const bool inverted = !degrees.shape[0] && !degrees.rows[0];
  const double n_rotated_latitudes = inverted ? (quadrature.n_theta + 1) / 2 : quadrature.n_theta;
  const FourierColumns shape = shape_columns(mirrored);
  const FourierColumns row = row_columns(kernels, mirrored);
  const double shape_fields = static_cast<double>(shape.count()) * (kernels.need_source_normal() ? 3.0 : 1.0);
  const double row_fields = static_cast<double>(row.count());
  const double n_nodes = static_cast<double>(quadrature.n_nodes()) / (mirrored ? 2.0 : 1.0);

  const double of_a_target =
      rotation(order, azimuthal_order, shape, degrees.shape) + legendre_sums(quadrature, shape_fields, degrees.shape) +
      fourier_sums(quadrature, shape_fields, n_rotated_latitudes) + n_nodes * kernel_values(kernels) +
      fourier_sums(quadrature, row_fields, n_rotated_latitudes) + legendre_sums(quadrature, row_fields, degrees.rows) +
      rotation(order, azimuthal_order, row, degrees.rows);
  const auto n_originals = static_cast<double>(sweep.images().originals().size());
  return sweep.n_latitudes() * n_originals * of_a_target + analysis(sweep, transform, subspace, fold > 1);
}

}  // namespace vehd

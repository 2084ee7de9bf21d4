#pragma once

#include "fem_check/cell_kernel.hpp"
#include "fem_check/cell_loops.hpp"
// The deal.II library contains the functions that read nodal values for single cells only.
#include <deal.II/matrix_free/evaluation_template_factory_hanging_nodes.templates.h>

namespace vehd::fem_check {

/// A field with this number of components on one group of cells: its nodal values, and its values or derivatives at the
/// Gauss points.
template <int n_components>
class CellValues {
 public:
  /// @param field   its number in the loops
  /// @param kernel  of the degree of the field and the points of the loops; must outlive this object
  CellValues(const CellLoops& loops, unsigned field, const CellKernel& kernel)
      : cell_(loops, field), kernel_(kernel), at_points_(cell_.begin_gradients()) {}

  void reinit(unsigned group) { cell_.reinit(group); }
  [[nodiscard]] unsigned n_points() const { return kernel_.n_points(); }
  /// Nodes per component.
  [[nodiscard]] unsigned n_nodes() const { return cell_.dofs_per_component; }
  [[nodiscard]] Lanes* nodal(unsigned component = 0) { return cell_.begin_dof_values() + component * n_nodes(); }

  /// Reads nodal values from one vector, or from the first vectors of a list, one per component.
  template <typename From>
  void read(const From& from) {
    cell_.read_dof_values(from, 0);
  }
  /// Adds the nodal values to one vector, or to the first vectors of a list, one per component.
  template <typename To>
  void add_to(To& to) {
    cell_.distribute_local_to_global(to, 0);
  }
  /// Subtracts a constant, which has no gradient: a large one would leave a rounding error.
  void remove_constants() {
    for (unsigned component = 0; component < n_components; ++component) {
      Lanes* values = nodal(component);
      const Lanes constant = values[0];
      for (unsigned i = 0; i < n_nodes(); ++i) values[i] -= constant;
    }
  }

  void evaluate_values() { for_each(&CellKernel::values); }
  void evaluate_gradients() { for_each(&CellKernel::gradients); }
  /// Replaces the nodal values by Σ_q φ_i(q) f(q), f the submitted values.
  void integrate_values() { for_each_back(&CellKernel::integrate_values); }
  /// Replaces the nodal values by Σ_q ∇φ_i(q)·f(q), f the submitted gradients.
  void integrate_gradients() { for_each_back(&CellKernel::integrate_gradients); }

  /// Value of the first component, until a value is submitted at this point.
  [[nodiscard]] const Lanes& value(unsigned q) const { return at_points_[q]; }
  void submit_value(const Lanes& value, unsigned q) { at_points_[q] = value * cell_.JxW(q); }
  /// Derivatives with respect to the unit coordinates, [3 x points]: one direction after the other.
  [[nodiscard]] Lanes* slopes(unsigned component = 0) { return at_points_ + component * 3 * n_points(); }
  /// ∇u, [component][direction].
  [[nodiscard]] dealii::Tensor<2, 3, Lanes> gradient(unsigned q) const {
    static_assert(n_components == 3);
    const dealii::Tensor<2, 3, Lanes> inverse = cell_.inverse_jacobian(q);
    dealii::Tensor<2, 3, Lanes> result;
    for (unsigned component = 0; component < 3; ++component) {
      const Lanes* slope = at_points_ + component * 3 * n_points() + q;
      for (unsigned d = 0; d < 3; ++d) {
        result[component][d] =
            inverse[d][0] * slope[0] + inverse[d][1] * slope[n_points()] + inverse[d][2] * slope[2 * n_points()];
      }
    }
    return result;
  }
  void submit_gradient(const dealii::Tensor<2, 3, Lanes>& flux, unsigned q) {
    static_assert(n_components == 3);
    const dealii::Tensor<2, 3, Lanes> inverse = cell_.inverse_jacobian(q);
    const Lanes weight = cell_.JxW(q);
    for (unsigned component = 0; component < 3; ++component) {
      Lanes* slope = slopes(component) + q;
      for (unsigned i = 0; i < 3; ++i) {
        slope[i * n_points()] = weight * (inverse[0][i] * flux[component][0] + inverse[1][i] * flux[component][1] +
                                          inverse[2][i] * flux[component][2]);
      }
    }
  }

  /// Transposed inverse: ∇ = inverse · derivatives with respect to the unit coordinates.
  [[nodiscard]] dealii::Tensor<2, 3, Lanes> inverse_jacobian(unsigned q) const { return cell_.inverse_jacobian(q); }
  [[nodiscard]] Lanes weight(unsigned q) const { return cell_.JxW(q); }

 private:
  void for_each(void (CellKernel::*evaluate)(const Lanes*, Lanes*) const) {
    for (unsigned component = 0; component < n_components; ++component) {
      (kernel_.*evaluate)(nodal(component), slopes(component));
    }
  }
  void for_each_back(void (CellKernel::*integrate)(Lanes*, Lanes*) const) {
    for (unsigned component = 0; component < n_components; ++component) {
      (kernel_.*integrate)(slopes(component), nodal(component));
    }
  }

  dealii::FEEvaluation<3, -1, 0, n_components, double, Lanes> cell_;
  const CellKernel& kernel_;
  Lanes* at_points_;  // memory of cell_
};

}  // namespace vehd::fem_check

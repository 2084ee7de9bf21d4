#pragma once

#include "fem_check/cell_kernel.hpp"
#include "fem_check/cell_loops.hpp"
// deal.II's library holds what its reading of nodal values calls for one cell at a time only.
#include <deal.II/matrix_free/evaluation_template_factory_hanging_nodes.templates.h>

namespace vehd::fem_check {

/// A field with this number of components on one group of cells: its nodal values, and its values or derivatives at the
/// Gauss points.
template <int n_components>
class CellValues {
 public:
  /// @param field   its number in the loops
  /// @param kernel  of its degree at the points of the loops; has to live as long as this
  CellValues(const CellLoops& loops, unsigned field, const CellKernel& kernel)
      : cell_(loops, field), kernel_(kernel), at_points_(cell_.begin_gradients()) {}

  void reinit(unsigned group) { cell_.reinit(group); }
  [[nodiscard]] unsigned n_points() const { return kernel_.n_points(); }
  /// Of one component.
  [[nodiscard]] unsigned n_nodes() const { return cell_.dofs_per_component; }
  [[nodiscard]] Lanes* nodal(unsigned component = 0) { return cell_.begin_dof_values() + component * n_nodes(); }

  /// Nodal values of a vector, or of as many as there are components, from the first on.
  template <typename From>
  void read(const From& from) {
    cell_.read_dof_values(from, 0);
  }
  /// Adds the nodal values to a vector, or to as many as there are components.
  template <typename To>
  void add_to(To& to) {
    cell_.distribute_local_to_global(to, 0);
  }
  /// A constant has no gradient: taken off, it leaves no rounding, however large it is.
  void remove_constants() {
    for (unsigned component = 0; component < n_components; ++component) {
      Lanes* values = nodal(component);
      const Lanes constant = values[0];
      for (unsigned i = 0; i < n_nodes(); ++i) values[i] -= constant;
    }
  }

  void evaluate_values() { for_each(&CellKernel::values); }
  void evaluate_gradients() { for_each(&CellKernel::gradients); }
  /// Nodal values become Σ_q φ_i(q) f(q), f what was submitted as value.
  void integrate_values() { for_each_back(&CellKernel::integrate_values); }
  /// Nodal values become Σ_q ∇φ_i(q)·f(q), f what was submitted as gradient.
  void integrate_gradients() { for_each_back(&CellKernel::integrate_gradients); }

  /// Of the first component, until something is submitted there.
  [[nodiscard]] const Lanes& value(unsigned q) const { return at_points_[q]; }
  void submit_value(const Lanes& value, unsigned q) { at_points_[q] = value * cell_.JxW(q); }
  /// Derivatives by unit coordinates, [3 x points]: one direction after the other.
  [[nodiscard]] Lanes* slopes(unsigned component = 0) { return at_points_ + component * 3 * n_points(); }
  /// [component][direction]
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

  /// Transposed: ∇ = inverse · derivatives by unit coordinates.
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
  Lanes* at_points_;  // memory of the cell's
};

}  // namespace vehd::fem_check

#pragma once

#include "fem_check/cell_values.hpp"
#include "fem_check/membrane_trace.hpp"
#include "fem_check/surface_terms.hpp"

namespace vehd::fem_check {

/// a(u, w) = Σ_side coefficient ∫ ∇u·∇w dV + membrane ∫_γ [[u]][[w]] dA + robin ∫_{r=R} u w dA, lengths in units of the
/// space.
struct ScalarForm {
  PerVesicle<double> inside = 1.0;
  double outside = 1.0;
  PerVesicle<double> membrane = 0.0;
  double robin = 0.0;
};

/// Coupling of the two values at each node of γ.
enum class Tie { none, inner_follows_outer, outer_follows_inner };

/// Homogeneous constraints: ties on γ, given values on the outer sphere and the wall, and one value on each side whose
/// constant would be undetermined.
struct Fixed {
  PerVesicle<Tie> tie = Tie::none;
  bool outer = false;
  bool wall = false;
  bool outer_value = false;
  std::vector<int> floating{};  ///< vesicles whose inside has an undetermined constant
};
Constraints make_constraints(const Space& space, const dealii::DoFHandler<3>& handler, const SheetPairs& pairs,
                             const std::vector<DofIndex>& outer_dofs, const Fixed& fixed);

/// Matrix-free operator of a scalar form on the elements of one handler: every product integrates over the cells. Rows
/// of fixed and tied nodes are those of the identity.
class Stiffness : public dealii::Subscriptor {
 public:
  /// @param handler   of scalar elements; must outlive this object
  /// @param n_points  Gauss points per direction and cell
  Stiffness(const Space& space, const dealii::DoFHandler<3>& handler, const Fixed& fixed, const ScalarForm& form,
            int n_points);

  void vmult(Distributed& to, const Distributed& from) const;
  void Tvmult(Distributed& to, const Distributed& from) const { vmult(to, from); }
  [[nodiscard]] DofIndex m() const { return handler_.n_dofs(); }
  /// Required by the Chebyshev preconditioner, which does not call it if given the diagonal.
  [[nodiscard]] static double el(DofIndex /*row*/, DofIndex /*column*/) {
    throw std::logic_error("no matrix is stored");
  }
  void initialize(Distributed& vector) const { loops_->initialize_dof_vector(vector); }

  /// Adds scale · Σ coefficient ∫ ∇u·∇w for nodal values u given on all ranks, tied nodes as they are.
  void add_cells(Distributed& to, double scale, const dealii::Vector<double>& u) const;
  /// ∫ ∇u·∇w over one side for the trace functions w of that side: [pairs], on all ranks.
  [[nodiscard]] Vector flux_functional(const dealii::Vector<double>& u, Side side) const;
  /// Adds nodal values, [dofs.size()], to the free degrees of freedom to which the nodes are tied.
  void add_at(Distributed& to, const std::vector<DofIndex>& dofs, const Vector& values) const;
  [[nodiscard]] Distributed inverse_diagonal() const;

  [[nodiscard]] const dealii::DoFHandler<3>& handler() const { return handler_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }
  [[nodiscard]] const OuterSphere& outer() const { return outer_; }
  [[nodiscard]] const SurfaceTerms& surface() const { return *surface_; }
  [[nodiscard]] const ScalarForm& form() const { return form_; }
  [[nodiscard]] const Space& space() const { return space_; }

 private:
  /// Σ coefficient ∫ ∇u·∇w for all nodes, on all ranks, tied nodes as they are.
  [[nodiscard]] dealii::Vector<double> cell_product(const dealii::Vector<double>& u,
                                                    const dealii::AlignedVector<Lanes>& coefficient) const;
  [[nodiscard]] int degree() const { return static_cast<int>(handler_.get_fe().degree); }

  const Space& space_;
  const dealii::DoFHandler<3>& handler_;
  ScalarForm form_;
  int n_points_;
  CellKernel kernel_;
  SheetPairs pairs_;
  OuterSphere outer_;
  Constraints constraints_;
  Constraints none_;
  std::shared_ptr<const CellLoops> loops_;
  dealii::AlignedVector<Lanes> metric_;
  dealii::AlignedVector<Lanes> coefficient_;
  std::unique_ptr<SurfaceTerms> surface_;
};

}  // namespace vehd::fem_check

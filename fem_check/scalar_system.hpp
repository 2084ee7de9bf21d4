#pragma once

#include "fem_check/membrane_trace.hpp"
#include "fem_check/space.hpp"

namespace vehd::fem_check {

/// A vector distributed over the ranks.
using Distributed = dealii::TrilinosWrappers::MPI::Vector;
/// A sparse matrix distributed over the ranks.
using DistributedMatrix = dealii::TrilinosWrappers::SparseMatrix;
/// Which degrees of freedom are tied or fixed.
using Constraints = dealii::AffineConstraints<double>;

/// a(u, w) = Σ_side coefficient ∫ ∇u·∇w dV + membrane ∫_γ [[u]][[w]] dA + robin ∫_{r=R} u w dA
struct ScalarForm {
  double inside = 1.0;
  double outside = 1.0;
  double membrane = 0.0;
  double robin = 0.0;
};

/// Matrix of a scalar form and a multigrid preconditioner for it. The preconditioner is built from linear elements on
/// the sub-cells between neighbouring nodes: spectrally equivalent at every degree, and sparse.
class ScalarSystem {
 public:
  ScalarSystem(const Space& space, const Constraints& constraints, const ScalarForm& form);

  [[nodiscard]] const DistributedMatrix& matrix() const { return matrix_; }
  [[nodiscard]] const dealii::TrilinosWrappers::PreconditionAMG& preconditioner() const { return preconditioner_; }
  [[nodiscard]] double seconds_assembly() const { return seconds_assembly_; }
  [[nodiscard]] double seconds_preconditioner() const { return seconds_preconditioner_; }

  /// Conjugate gradients from zero. The result is known on all ranks.
  /// @throws SolveError if the residual does not fall to `tolerance` times that of zero
  dealii::Vector<double> solve(const Distributed& right_side, double tolerance, int& iterations) const;

 private:
  void assemble(const ScalarForm& form);
  void assemble_preconditioner(const ScalarForm& form);

  const Space& space_;
  const Constraints& constraints_;
  DistributedMatrix matrix_;
  DistributedMatrix sub_cell_matrix_;  // the multigrid refers to it
  dealii::TrilinosWrappers::PreconditionAMG preconditioner_;
  double seconds_assembly_ = 0.0;
  double seconds_preconditioner_ = 0.0;
};

/// Zero vector to add a right-hand side to; compress it before use.
Distributed right_side(const Space& space, const dealii::DoFHandler<3>& handler);

/// Adds `scale` Σ coefficient ∫ ∇u·∇w for nodal values u known on all ranks.
void add_stiffness_action(const Space& space, const Constraints& constraints, const ScalarForm& form, double scale,
                          const dealii::Vector<double>& u, Distributed& result);
/// Adds functionals on γ, one value per pair, for the inner and for the outer test functions.
void add_membrane_functionals(const Space& space, const Constraints& constraints, const Vector& inner,
                              const Vector& outer, Distributed& result);
/// Adds ∫_{r=R} f w, f given at positions on the outer sphere.
void add_outer_functional(const Space& space, const Constraints& constraints,
                          const std::function<double(const Vector3&)>& f, Distributed& result);

/// ∫ ∇u·∇w over the inside for every inner trace function w: one value per pair, on all ranks.
Vector inner_flux_functional(const Space& space, const dealii::Vector<double>& u);

}  // namespace vehd::fem_check

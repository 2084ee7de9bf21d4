#pragma once

#include "fem_check/discretisation.hpp"
#include "fem_check/exterior_field.hpp"
#include "fem_check/flow.hpp"
#include "fem_check/multigrid.hpp"

namespace vehd::fem_check {

/// Velocity components and pressure, distributed; more blocks may follow.
using Blocks = dealii::LinearAlgebra::distributed::BlockVector<double>;

/// Of the fluids on both sides.
struct Viscosities {
  PerVesicle<double> inside;
  double outside;
};

/// Taylor–Hood system of Stokes flow, blocks u_x, u_y, u_z, p. The velocity form is μ∇u:∇w; where viscosities differ,
/// what each is more than the smallest of them multiplies ∇u:∇wᵀ. Lengths in units R of the space, viscosities over
/// that of the outside: the velocity has its own unit, the pressure is p R/μ_e, and functionals of forces are divided
/// by μ_e R. No matrix: the cells are integrated in every product.
class StokesSystem {
 public:
  /// @param wall  of the mesh, if it has one
  /// @throws std::invalid_argument for a degree below 2 or a viscosity that is not positive
  StokesSystem(const Discretisation& discretisation, const Viscosities& viscosity, WallFlow wall,
               int exterior_degree = usual_exterior_degree);
  /// The system with another exterior degree; all else is shared.
  [[nodiscard]] StokesSystem with_exterior(int exterior_degree) const;

  /// A vector of zeros with these blocks.
  [[nodiscard]] Blocks zero() const;
  /// Functional of the force per area of the membrane on the fluid in the background flow A x.
  /// @throws std::invalid_argument for a missing force or a gradient with a trace
  [[nodiscard]] Blocks load(const VectorOnSurface& force, const Matrix3& gradient) const;

  /// Symmetric: [[A, Bᵀ], [B, 0]] with B = −∫ q div u. Uses the first four blocks only, as precondition() does.
  void vmult(Blocks& to, const Blocks& from) const;
  /// Symmetric and positive definite: multigrid for A, the pressure mass over μ for the Schur complement, and
  /// corrections for the few motions and pressures that these miss where viscosities differ much.
  void precondition(Blocks& to, const Blocks& from) const;
  /// Block triangular, [[P_A⁻¹, 0], [B, −P_S⁻¹]]⁻¹ with the blocks P_A and P_S of precondition(): were they exact, a
  /// solver that needs no symmetry would take two steps.
  /// Source: Murphy, Golub and Wathen 2000
  void precondition_triangular(Blocks& to, const Blocks& from) const;
  /// Generalised minimal residuals from `start` to the residual `tolerance` relative to the right-hand side, both in
  /// the norm of precondition(). Adds to iterations and notes the residual in the cost.
  /// @throws SolveError if they do not get there
  void solve(const Blocks& right_side, double tolerance, Blocks& solution, Cost& cost) const;

  /// Nodal values of a velocity component, [degrees of freedom], on all ranks.
  [[nodiscard]] dealii::Vector<double> velocity(const Blocks& solution, unsigned component) const;
  /// Nodal values of the pressure, [degrees of freedom], on all ranks, in the user's unit.
  [[nodiscard]] dealii::Vector<double> pressure(const Blocks& solution) const;

  [[nodiscard]] const Viscosities& viscosities() const;
  [[nodiscard]] WallFlow wall() const;
  [[nodiscard]] const Space& space() const { return *shared_space(); }
  [[nodiscard]] const std::shared_ptr<const Space>& shared_space() const;
  [[nodiscard]] const std::shared_ptr<const dealii::DoFHandler<3>>& pressure_dofs() const;
  /// Ties of the two sheets, and where they are added up.
  [[nodiscard]] const Stiffness& diffusion() const;
  /// Scale of the functional of a force, μ_e R.
  [[nodiscard]] double functional_unit() const;
  /// Of the block of the pressure, μ_e/R.
  [[nodiscard]] double pressure_unit() const;

 private:
  struct Implementation;
  [[nodiscard]] std::shared_ptr<const HarmonicTerms> exterior_terms(int exterior_degree) const;

  std::shared_ptr<const Implementation> implementation_;
  int exterior_degree_;
  std::shared_ptr<const HarmonicTerms> exterior_;
};

struct FlowOperators::Data {
  StokesSystem system;  ///< with the usual fields outside
  int degree;           ///< of the velocity
  double seconds;       ///< that setting up took
};

/// That of the operators with the exterior degree of the problem.
/// @throws std::invalid_argument if the problem has other viscosities or another wall
StokesSystem system_for(const FlowOperators& operators, const FlowProblem& problem);

/// Velocity and pressure of another solution on the same mesh, into the first four blocks.
void begin_from(const FlowSolution& start, const StokesSystem& system, Blocks& solution);

/// The flow of a solution, of whose blocks the first four are used.
FlowSolution flow_solution(const StokesSystem& system, const FlowProblem& problem, const Blocks& solution, Cost cost);

}  // namespace vehd::fem_check

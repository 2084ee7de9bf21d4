#pragma once

#include "fem_check/discretisation.hpp"
#include "fem_check/exterior_field.hpp"
#include "fem_check/flow.hpp"
#include "fem_check/multigrid.hpp"

namespace vehd::fem_check {

/// Velocity components and pressure, distributed; further blocks can follow.
using Blocks = dealii::LinearAlgebra::distributed::BlockVector<double>;

/// Viscosities of the fluids on both sides.
struct Viscosities {
  PerVesicle<double> inside;
  double outside;
};

/// Taylor–Hood system of Stokes flow, blocks u_x, u_y, u_z, p. The velocity form is μ∇u:∇w; if viscosities differ,
/// their excess over the smallest one multiplies ∇u:∇wᵀ. Lengths are in units of R, viscosities of that of the outside:
/// the velocity keeps its unit, the pressure is p R/μ_e, and functionals of forces are divided by μ_e R. Matrix-free:
/// every product integrates over the cells.
class StokesSystem {
 public:
  /// @param wall  condition at the wall, if the mesh has one
  /// @throws std::invalid_argument for a degree below 2 or a viscosity that is not positive
  StokesSystem(const Discretisation& discretisation, const Viscosities& viscosity, WallFlow wall,
               int exterior_degree = usual_exterior_degree);
  /// The system with another exterior degree; all other data are shared.
  [[nodiscard]] StokesSystem with_exterior(int exterior_degree) const;

  /// Zero vector with the blocks of the system.
  [[nodiscard]] Blocks zero() const;
  /// Functional of the membrane's force per area on the fluid, in the background flow A x.
  /// @throws std::invalid_argument for a missing force or a gradient with a trace
  [[nodiscard]] Blocks load(const VectorOnSurface& force, const Matrix3& gradient) const;

  /// Symmetric: [[A, Bᵀ], [B, 0]] with B = −∫ q div u. Uses only the first four blocks, as precondition() does.
  void vmult(Blocks& to, const Blocks& from) const;
  /// Symmetric and positive definite: multigrid for A, the pressure mass over μ for the Schur complement, and
  /// corrections for the few motions and pressures that these do not capture at a high viscosity contrast.
  void precondition(Blocks& to, const Blocks& from) const;
  /// Block triangular, [[P_A⁻¹, 0], [B, −P_S⁻¹]]⁻¹ with the blocks P_A and P_S of precondition(): if they were exact, a
  /// method for nonsymmetric equations would take two steps.
  /// Source: Murphy, Golub and Wathen 2000
  void precondition_triangular(Blocks& to, const Blocks& from) const;
  /// Generalised minimal residual method from the initial guess `solution` until the residual relative to the
  /// right-hand side is `tolerance`, in the norm of precondition(). Updates iterations and solver_error of the cost.
  /// @throws SolveError if the tolerance is not reached
  void solve(const Blocks& right_side, double tolerance, Blocks& solution, Cost& cost) const;

  /// Nodal values of a velocity component, [degrees of freedom], on all ranks.
  [[nodiscard]] dealii::Vector<double> velocity(const Blocks& solution, unsigned component) const;
  /// Nodal values of the pressure, [degrees of freedom], on all ranks, in the user's units.
  [[nodiscard]] dealii::Vector<double> pressure(const Blocks& solution) const;

  [[nodiscard]] const Viscosities& viscosities() const;
  [[nodiscard]] WallFlow wall() const;
  [[nodiscard]] const Space& space() const { return *shared_space(); }
  [[nodiscard]] const std::shared_ptr<const Space>& shared_space() const;
  [[nodiscard]] const std::shared_ptr<const dealii::DoFHandler<3>>& pressure_dofs() const;
  /// Scalar operator whose constraints tie the two sides of γ.
  [[nodiscard]] const Stiffness& diffusion() const;
  /// Unit of the functional of a force, μ_e R.
  [[nodiscard]] double functional_unit() const;
  /// Unit of the pressure block, μ_e/R.
  [[nodiscard]] double pressure_unit() const;

 private:
  struct Implementation;
  [[nodiscard]] std::shared_ptr<const HarmonicTerms> exterior_terms(int exterior_degree) const;

  std::shared_ptr<const Implementation> implementation_;
  int exterior_degree_;
  std::shared_ptr<const HarmonicTerms> exterior_;
};

struct FlowOperators::Data {
  StokesSystem system;  ///< with the usual exterior fields
};

/// The system of the operators with the exterior degree of the problem.
/// @throws std::invalid_argument if the problem has other viscosities or another wall
StokesSystem system_for(const FlowOperators& operators, const FlowProblem& problem);

/// Interpolates velocity and pressure of another solution on the same mesh into the first four blocks.
void begin_from(const FlowSolution& start, const StokesSystem& system, Blocks& solution);

/// Solution of a flow from the first four blocks.
FlowSolution flow_solution(const StokesSystem& system, const FlowProblem& problem, const Blocks& solution, Cost cost);

}  // namespace vehd::fem_check

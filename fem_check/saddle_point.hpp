#pragma once

#include "fem_check/scalar_system.hpp"

namespace vehd::fem_check {

/// Velocity components and pressure, distributed.
using Blocks = dealii::TrilinosWrappers::MPI::BlockVector;

/// Of the fluids on both sides.
struct Viscosities {
  double inside;
  double outside;
};

/// Taylor–Hood system of Stokes flow, blocks u_x, u_y, u_z, p. The velocity form is μ∇u:∇w, one scalar matrix for all
/// three components; where viscosities differ, ∇u:∇wᵀ comes on the side of the larger one.
class SaddlePoint {
 public:
  SaddlePoint(const Space& space, const dealii::DoFHandler<3>& pressure_dofs, const Constraints& constraints,
              const Viscosities& viscosity);

  /// A vector of zeros with these blocks.
  [[nodiscard]] Blocks zero() const;
  [[nodiscard]] double seconds_assembly() const { return seconds_assembly_; }

  /// Symmetric: [[A, Bᵀ], [B, 0]] with B = −∫ q div u.
  void vmult(Blocks& result, const Blocks& x) const;
  /// An approximate inverse of the diagonal, symmetric and positive definite: multigrid for A, the pressure mass over μ
  /// for the Schur complement. Further blocks are left alone, here and in vmult.
  void precondition(Blocks& result, const Blocks& x) const;
  /// Minimal residuals from zero with multigrid for A and the pressure mass over μ for the Schur complement.
  /// @throws SolveError if the residual does not fall to `tolerance` times that of zero
  Blocks solve(const Blocks& right_side, double tolerance, int& iterations) const;

 private:
  void assemble_divergence();
  void assemble_pressure_mass(const Viscosities& viscosity);
  void assemble_contrast(const Viscosities& viscosity);

  const Space& space_;
  const dealii::DoFHandler<3>& pressure_dofs_;
  std::vector<DofIndex> tied_;  // the degree of freedom that stands for each
  ScalarSystem diffusion_;
  std::array<DistributedMatrix, 3> divergence_;
  std::vector<DistributedMatrix> contrast_;  // test and trial component: 00, 01, 02, 11, 12, 22; empty if equal
  DistributedMatrix pressure_mass_;
  dealii::TrilinosWrappers::PreconditionChebyshev pressure_inverse_;
  double seconds_assembly_ = 0.0;
};

}  // namespace vehd::fem_check

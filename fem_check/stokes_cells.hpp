#pragma once

#include "fem_check/cell_values.hpp"

namespace vehd::fem_check {

/// Cell integrals of the Stokes operator and of the pressure mass: velocity components in field 0 of the loops,
/// pressure of one degree less in field 1.
class StokesCells {
 public:
  /// Viscosities are relative to that of the outside; their excess over the smallest one multiplies ∇u:∇wᵀ.
  StokesCells(const Space& space, const dealii::DoFHandler<3>& pressure_dofs, const Constraints& velocity_constraints,
              const PerVesicle<double>& viscosity_inside);

  /// Excess of the outside.
  [[nodiscard]] double contrast_outside() const { return contrast_outside_; }

  /// u_x, u_y, u_z, p
  using Parts = std::vector<Distributed*>;
  /// to = Stokes operator times from.
  void apply(const Parts& to, const Parts& from) const;
  /// to = −∫ q div u, the pressure block of that product.
  /// @param from  u_x, u_y, u_z
  void apply_divergence(Distributed& to, const Parts& from) const;
  /// to = ∫ p q/μ
  void apply_pressure_mass(Distributed& to, const Distributed& from) const;
  [[nodiscard]] Distributed inverse_pressure_diagonal() const;

  void initialize_velocity(Distributed& vector) const { loops_->initialize_dof_vector(vector, 0); }
  void initialize_pressure(Distributed& vector) const { loops_->initialize_dof_vector(vector, 1); }

 private:
  const Space& space_;
  int degree_;  // of the velocity
  CellKernel velocity_kernel_, pressure_kernel_;
  Constraints none_;
  std::shared_ptr<const CellLoops> loops_;
  double contrast_outside_;
  dealii::AlignedVector<Lanes> viscosity_;
  dealii::AlignedVector<Lanes> contrast_;
  dealii::AlignedVector<Lanes> fluidity_;  // 1/μ
};

}  // namespace vehd::fem_check

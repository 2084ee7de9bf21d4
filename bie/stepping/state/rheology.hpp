#pragma once

#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// Contribution of vesicles to the stress and the dipole of a suspension, at one time. Particle stresses are multiplied
/// by the volume of the suspension,
///   −∫ ½(f xᵀ + x fᵀ) dA + μ(Λ − 1) ∫ (v nᵀ + n vᵀ) dA,
/// f a force on the fluid, Λ the viscosity ratio, x relative to `centre`: the stress of forces that do not add up to
/// zero depends on the reference point.
struct Rheology {
  double volume = 0.0;               ///< of the vesicles
  Vector3 centre = Vector3::Zero();  ///< centroid of that volume
  // −∫ f (x − centre)ᵀ dA; the symmetric part contributes to the particle stress, the other one is a torque.
  Matrix3 bending = Matrix3::Zero();
  Matrix3 tension = Matrix3::Zero();
  Matrix3 electric = Matrix3::Zero();
  Matrix3 others = Matrix3::Zero();     ///< of gravity, contact, spontaneous curvature
  Matrix3 viscosity = Matrix3::Zero();  ///< μ(Λ − 1) ∫ (v nᵀ + n vᵀ) dA
  // ∫f dA on the fluid; zero for bending and tension.
  Vector3 electric_force = Vector3::Zero();
  Vector3 other_force = Vector3::Zero();
  Vector3 dipole = Vector3::Zero();  ///< ε ∫ (q x − V_m n) dA, the dipole of the far field
  double electric_power = 0.0;       ///< σ_e E_∞·dipole/ε, see power()
  // Of the fluid without vesicles.
  Matrix3 gradient = Matrix3::Zero();  ///< dv_i/dx_j of a linear flow, zero without one
  double fluid_viscosity = 1.0;        ///< μ

  /// Sum of all contributions; not symmetric if a torque acts.
  [[nodiscard]] Matrix3 moment() const;
  /// Additional power of flow and field due to the vesicles.
  [[nodiscard]] double power() const;
  /// Stress : E/(2μ E:E volume) of the rate of strain E, stress_xz/(μ rate volume) in a shear along x; 0 without a
  /// linear flow.
  /// Accuracy: 5/2 of inextensible spheres to 1e-11 (tests/stepping/evaluation/rheology_test.cpp)
  [[nodiscard]] double intrinsic_viscosity() const;
};

/// The sum over all vesicles, about the centroid of their volume.
/// Source: Batchelor 1970
Rheology together(const std::vector<Rheology>& vesicles);

/// Rheology in other axes: vectors v become R v, points origin + R x.
Rheology rotated(const Matrix3& rotation, const Vector3& origin, Rheology rheology);

}  // namespace vehd

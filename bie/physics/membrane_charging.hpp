#pragma once

#include "bie/linear/solve_report.hpp"
#include "bie/physics/electric.hpp"

namespace vehd {

/// A membrane in a field that charges.
struct ChargingMembrane {
  ElectricMembrane in_field;
  ChargingParameters charging;
};

/// The equation (½ + ηS′)(a V − b) − κ D′[V] = κ E·n of one membrane, weighted by J and divided by a + κ/R, which may
/// be of any size; κ = σ_i σ_e/(σ_i + σ_e). Degree 0 holds ∫(a V − b) dA = 0, as no net current leaves a membrane, and
/// where a = 0 that V has no mean.
/// Source: paper Eqs. (14), (29), (30), without the inverse
class ChargingEquation {
 public:
  /// Both must outlive it. @param a  ≥ 0: C_m/dt + G_m
  ChargingEquation(const ElectricParameters& electric, const Membrane& membrane, double a);
  /// The same with an `a` that varies over the membrane. @param a  ≥ 0, values on the upsampled grid
  ChargingEquation(const ElectricParameters& electric, const Membrane& membrane, const Vector& a);

  /// Left side without b: what V does on its own membrane. Coefficients of degree p, as all here.
  [[nodiscard]] Vector own(const Vector& potential) const;
  /// Inverse of `own` on the sphere of the same area.
  [[nodiscard]] Vector sphere_inverse(const Vector& residual) const;
  /// Of b and the field.
  [[nodiscard]] Vector right_side(const Vector& b) const;
  /// The same. @param b  values on the upsampled grid
  [[nodiscard]] Vector right_side_of_values(const Vector& b) const;
  /// Factor of any further flux J n·∇φ through the membrane, a length.
  [[nodiscard]] double conduction() const { return conduction_; }

 private:
  [[nodiscard]] Vector right_side_of_weighted(const Vector& weighted_b, bool is_zero) const;
  [[nodiscard]] Vector weighted_storage(const Vector& potential) const;

  const ElectricParameters& electric_;
  const Membrane& membrane_;
  double eta_, size_, storage_, conduction_;
  Vector varying_storage_;  // of every point, and storage_ its mean; empty where it is the same everywhere
};

/// Solves (½ + ηS′)(a V − b) − κ D′[V] = κ E·n with an a that varies over the membrane.
/// @param a, b       values on the upsampled grid, a > 0
/// @param potential  where the solve starts on input, V on output
SolveReport solve_varying_charging(const ElectricParameters& electric, const Membrane& membrane, const Vector& a,
                                   const Vector& b, double tolerance, Vector& potential);

/// C_m on the upsampled grid.
Vector capacitance_of(const ChargingParameters& charging, const Membrane& membrane);
/// G_m on the upsampled grid.
Vector conductance_of(const ChargingParameters& charging, const Membrane& membrane);

/// Do C_m or G_m differ from place to place, or is there a pump? Then C_m V̇ + G_m V + J_p = −σ_i ∂φ_i/∂n.
bool charges_by_place(const Membrane& membrane);

/// The current through a membrane at every point, outwards and linear in V there: G V + J, values on the upsampled
/// grid.
struct MembraneCurrent {
  Vector conductance, constant;
};
/// G_m V + J_p.
MembraneCurrent membrane_current(const ElectricParameters& electric, const ChargingParameters& charging,
                                 const Membrane& membrane);

/// What an implicit step of charging asks for: a = C_m/dt + G_m and b = (C_m/dt) V − J_p, values on the upsampled grid.
struct ChargingStep {
  Vector a, b;
};
/// @param dt         > 0; infinite for the steady state
/// @param potential  V_m before the step, coefficients
ChargingStep charging_step(const ElectricParameters& electric, const ChargingParameters& charging,
                           const Membrane& membrane, double dt, const Vector& potential);

/// V_m after one backward-Euler step of (4e)/(14), Eq. (30), in one solve at every contrast and time constant:
/// with a = C_m/dt + G_m, b = (C_m/dt) V_m, κ = σ_i σ_e/(σ_i + σ_e), the unknown V obeys
///   (½ + ηS′)(a V − b) − κ D′[V] = κ E·n.
/// Where C_m and G_m differ from place to place or a pump works, a and b are those of charging_step.
/// @param potential  V_m before the step on input, after it on output
/// @param dt         > 0
/// @param tolerance  of the preconditioned residual, relative
/// Accuracy: first order in dt, spectral in space; each step on the sphere is backward Euler to 1e-11
/// (tests/physics/charging_test.cpp)
/// Source: paper Eqs. (14), (29), (30), without the inverse
SolveReport charge_membrane(const ElectricParameters& electric, const ChargingParameters& charging,
                            const Membrane& membrane, double dt, double tolerance, Vector& potential);

/// Steady V_m: C_m/dt → 0 in charge_membrane.
/// @throws InputError if nothing determines it (a membrane and a fluid that both insulate, or an insulating membrane
///     with a pump)
/// @param potential  a first guess on input, the steady V_m on output
/// Accuracy: spectral; on the sphere to 1e-11 (tests/physics/charging_test.cpp), on an insulating 2:1 prolate to 1e-10
/// (tests/physics/electric_prolate_test.cpp)
/// Source: paper Eq. (14) without its first term
SolveReport steady_potential(const ElectricParameters& electric, const ChargingParameters& charging,
                             const Membrane& membrane, double tolerance, Vector& potential);

}  // namespace vehd

#pragma once

#include <complex>
#include <vector>

#include "bie/physics/current_law.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

/// K = σ + iωε of the fluids on both sides; K = σ without displacement currents.
struct ComplexConductivities {
  std::complex<double> inside, outside;

  /// (K_i − K_e)/(K_i + K_e), as η of Eq. (11).
  [[nodiscard]] std::complex<double> contrast() const { return (inside - outside) / (inside + outside); }
};

/// @param electric  with averaged_frequency
ComplexConductivities complex_conductivities(const ElectricParameters& electric);

/// y = G_m + iωC_m of a membrane at this frequency, per area.
/// Source: paper Eq. (4e)
std::complex<double> membrane_admittance(const ChargingParameters& charging, double frequency);

/// Fields of one membrane in a field E cos ωt after all transients. A complex amplitude z stands for Re(z e^{iωt});
/// its real and imaginary parts are columns.
struct AveragedField {
  Matrix potential;  ///< V_m, coefficients, [n_coefficients x 2]
  Matrix charge;     ///< q = [[∂φ/∂n]], coefficients, [n_coefficients x 2]
  Matrix force;      ///< f_E, mean over a period, on the upsampled grid, [n_points x 3]
};

/// Fields of several membranes; empty for membranes of other ranks, see Interaction.
struct AveragedFields {
  std::vector<AveragedField> membranes;
  SolveReport report;
};

/// Solves for the complex amplitudes of all membranes together,
///   (½ + ηS′) y V − κ D′[V] = κ E·n,   y = G_m + iωC_m,   η and κ of K = σ + iωε,
/// with the layers of all membranes and y at every point if C_m or G_m vary over the membrane, and computes the mean of
/// the force over a period,
///   ⟨f_E⟩ = [[½ ε Re(E* (E·n)) − ¼ ε |E|² n]].
/// @param membranes  each with averaged_frequency
/// @throws InputError if there are several membranes and a fluid that does not conduct
/// Accuracy: spectral; V_m, q and the force on a sphere to 1e-10 from 10² to 10⁸ Hz, on a shape without symmetry the
/// steady state of the time-stepped equations (tests/physics/averaged_field_test.cpp)
/// Source: paper Eqs. (3), (11)–(15) at one frequency; Vlahovska et al. 2009 for the sphere
AveragedFields solve_averaged_fields(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                                     double tolerance);

/// Sphere of radius a in a field E cos ωt along its axis θ = 0. With K = σ + iωε, y = G_m + iωC_m, κ = K_i/K_e and
/// s = K_e/(ay) the field inside is A E, A = 3/(2 + κ + 2κs), and the one outside has the amplitudes κA E cos θ along
/// the normal and (3/2 − κA/2) E sin θ along the meridian. The P₂ part of normal and tangential stress is
///   Q(t) = Q + Re(Q₂ e^{2iωt}),   Q = ε_e |3/2 + κA/2|² − 4ε_i |A|²,   Q₂ = ε_e (3/2 + κA/2)² − 4ε_i A²
/// in units of E²/6 on an inextensible membrane, which becomes prolate along the field if Q > 0.
struct SphereInAcField {
  std::complex<double> inside;             ///< A
  std::complex<double> outside;            ///< κA
  std::complex<double> potential;          ///< V_m over E cos θ, a length
  double drive;                            ///< Q, a permittivity
  std::complex<double> alternating_drive;  ///< Q₂
};

/// @param electric  with averaged_frequency
/// Accuracy: closed form; Q changes sign as published (tests/physics/averaged_field_test.cpp)
/// Source: Vlahovska et al. 2009
SphereInAcField sphere_in_ac_field(const ElectricParameters& electric, const ChargingParameters& charging,
                                   double radius);

/// Relative amplitude of the motion of such a sphere at twice the frequency, which averaging neglects: amplitude of s₂
/// in r = a(1 + s₂P₂), E²|Q₂|/((32 + 23λ) μ_e 2ω).
/// @param viscosity_ratio  λ = μ_i/μ_e
/// Source: the quasi-spherical shape equation of Vlahovska et al. 2009
double ripple_amplitude(const ElectricParameters& electric, const ChargingParameters& charging, double radius,
                        double viscosity, double viscosity_ratio);

}  // namespace vehd

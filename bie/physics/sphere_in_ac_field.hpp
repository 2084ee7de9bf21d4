#pragma once

#include <complex>

#include "bie/physics/parameters.hpp"

namespace vehd {

/// A sphere of one radius in a field E cos ωt along its axis θ = 0. With K = σ + iωε, y = G_m + iωC_m, κ = K_i/K_e and
/// s = K_e/(ay) the field inside is A E, A = 3/(2 + κ + 2κs), and the one outside has the amplitudes κA E cos θ along
/// the normal and (3/2 − κA/2) E sin θ along the meridian. An inextensible membrane feels
///   Q(t) = Q + Re(Q₂ e^{2iωt}),   Q = ε_e |3/2 + κA/2|² − 4ε_i |A|²,   Q₂ = ε_e (3/2 + κA/2)² − 4ε_i A²
/// of the P₂ part of normal and tangential stress, in units of E²/6: it becomes prolate along the field where Q > 0.
struct SphereInAcField {
  std::complex<double> inside;             ///< A
  std::complex<double> outside;            ///< κA
  std::complex<double> potential;          ///< V_m over E cos θ, a length
  double drive;                            ///< Q, a permittivity
  std::complex<double> alternating_drive;  ///< Q₂
};

/// @param electric  of an averaged frequency
/// Accuracy: closed form; where Q changes its sign as published (tests/physics/averaged_field_test.cpp)
/// Source: Vlahovska et al. 2009
SphereInAcField sphere_in_ac_field(const ElectricParameters& electric, const ChargingParameters& charging,
                                   double radius);

/// Amplitude over the radius of the motion of such a sphere at twice the frequency, which averaging leaves out: that of
/// s₂ in r = a(1 + s₂P₂), E²|Q₂|/((32 + 23λ) μ_e 2ω).
/// @param viscosity_ratio  λ = μ_i/μ_e
/// Source: the quasi-spherical shape equation of Vlahovska et al. 2009
double ripple_amplitude(const ElectricParameters& electric, const ChargingParameters& charging, double radius,
                        double viscosity, double viscosity_ratio);

}  // namespace vehd

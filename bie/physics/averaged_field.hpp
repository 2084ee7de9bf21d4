#pragma once

#include <complex>
#include <vector>

#include "bie/physics/current_law.hpp"

namespace vehd {

/// K = σ + iωε of the fluids on both sides; K = σ without displacement currents.
struct ComplexConductivities {
  std::complex<double> inside, outside;

  /// (K_i − K_e)/(K_i + K_e), as η of Eq. (11).
  [[nodiscard]] std::complex<double> contrast() const { return (inside - outside) / (inside + outside); }
  /// K_i K_e/(K_i + K_e), as κ of Eq. (14).
  [[nodiscard]] std::complex<double> series() const { return inside * (outside / (inside + outside)); }
};

/// @param electric  of an averaged frequency
ComplexConductivities complex_conductivities(const ElectricParameters& electric);

/// y = G_m + iωC_m of a membrane at this frequency.
std::complex<double> membrane_admittance(const ChargingParameters& charging, double frequency);

/// What a field E cos ωt makes of one membrane after all transients. A complex amplitude z stands for Re(z e^{iωt});
/// its real and imaginary parts are columns.
struct AveragedField {
  Matrix potential;  ///< V_m, coefficients, [n_coefficients x 2]
  Matrix charge;     ///< q = [[∂φ/∂n]], coefficients, [n_coefficients x 2]
  Matrix force;      ///< f_E, mean over a period, on the upsampled grid, [n_points x 3]
};

/// Those of several membranes; of membranes of other ranks, see Interaction, they are empty.
struct AveragedFields {
  std::vector<AveragedField> membranes;
  SolveReport report;
};

/// Solves for the complex amplitudes of all membranes together,
///   (½ + ηS′) y V − κ D′[V] = κ E·n,   y = G_m + iωC_m,   η and κ of K = σ + iωε,
/// the layers being those of all membranes and y that of every point where C_m or G_m differ from place to place, and
/// takes the mean of the force over a period,
///   ⟨f_E⟩ = [[½ ε Re(E* (E·n)) − ¼ ε |E|² n]].
/// @param membranes  each with the averaged frequency
/// @throws InputError where several membranes lie beside a fluid that lets no current through
/// Accuracy: spectral; V_m, q and the force on a sphere to 1e-10 from 10² to 10⁸ Hz, on a shape without symmetry the
/// steady state of the time-stepped equations (tests/physics/averaged_field_test.cpp)
/// Source: paper Eqs. (3), (11)–(15) at one frequency; Vlahovska et al. 2009 for the sphere
AveragedFields solve_averaged_fields(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                                     double tolerance);

}  // namespace vehd

#pragma once

#include "bie/physics/poration_reaction.hpp"

namespace vehd {

/// Density N of pores of one radius.
///
///   dN/dt = α exp((V/V_ep)²) [1 − (N/N_0) exp(−q (V/V_ep)²)],  g = N g_p
struct PoreParameters {
  double creation_rate = 1.0;     ///< α, per area and time
  double potential = 1.0;         ///< V_ep
  double rest_density = 1.0;      ///< N_0, per area
  double exponent = 1.0;          ///< q
  double pore_conductance = 0.0;  ///< g_p
};

/// g_p = 2π r² σ_p/(π r + 2h) of a pore of radius r through a membrane of thickness h.
double pore_conductance(double radius, double thickness, double conductivity);
/// σ_p = (σ_e − σ_i)/ln(σ_e/σ_i), of fluids that both conduct.
double pore_conductivity(double inside, double outside);

/// The state is s = ln(N/N_0), which is smooth where N itself rises by orders of magnitude within a few degrees of
/// latitude, and which no truncation makes negative.
/// Accuracy: implicit steps to rounding; N at a point in a varying potential to 1e-8
/// (tests/physics/poration_reaction_test.cpp)
/// Source: DeBruin and Krassowska 1999
class PoreDensity : public PorationReaction {
 public:
  explicit PoreDensity(const PoreParameters& parameters) : p_(parameters) {}

  [[nodiscard]] double start() const override { return 0.0; }
  [[nodiscard]] Slope conductance(double s) const override;
  [[nodiscard]] double rate(double s, double potential) const override;
  [[nodiscard]] Slope implicit_step(double known, double dt, double potential) const override;
  [[nodiscard]] double limited(double from, double to) const override;
  [[nodiscard]] double measure(double s) const override;
  [[nodiscard]] EffectDescription description() const override;

 private:
  PoreParameters p_;
};

}  // namespace vehd

#pragma once

#include <optional>

#include "bie/physics/effects/effect.hpp"

namespace vehd {

/// Thresholds above which poration is reported; they do not affect the dynamics. At least one of the two is set.
struct PorationCriterion {
  std::optional<double> potential{};  ///< V_c of |V_m|
  std::optional<double> tension{};    ///< λ_c of λ + ½ C_m V_m²
  bool operator==(const PorationCriterion&) const = default;
};

/// Poration of a membrane, which raises its conductance: a state s at every material point, driven by V_m there.
///
///   ds/dt = r(s, V),  current through the membrane (G_m + g(s)) V
///
/// All functions refer to one material point.
class PorationReaction : public Effect {
 public:
  /// A value with its slope.
  struct Slope {
    double value = 0.0;
    double slope = 0.0;
  };

  /// s of a membrane at rest.
  [[nodiscard]] virtual double start() const = 0;
  /// g ≥ 0, conductance per area, and dg/ds ≥ 0.
  [[nodiscard]] virtual Slope conductance(double s) const = 0;
  /// r, per time.
  [[nodiscard]] virtual double rate(double s, double potential) const = 0;
  /// The s that solves s − dt r(s, V) = known, and ds/dV, which has the sign of V.
  /// @param dt  > 0, of any size
  [[nodiscard]] virtual Slope implicit_step(double known, double dt, double potential) const = 0;
  /// Potential between `from` and `to` up to which the slopes at `from` are useful, for Newton's method.
  [[nodiscard]] virtual double damped_potential(double from, double to) const = 0;
  /// Value in the history: the porosity, or the density of pores.
  [[nodiscard]] virtual double measure(double s) const = 0;
};

/// Porosity X of a membrane that opens above a potential and reseals below it.
///
///   dX/dt = max((β − X)/τ_ep, (β − X)/τ_res),  β = ½ [1 + tanh k(|V|/V_r − 1)],  g = G_1 X
struct PorosityParameters {
  double conductance = 0.0;     ///< G_1
  double potential = 1.0;       ///< V_r
  double steepness = 1.0;       ///< k
  double poration_time = 1.0;   ///< τ_ep
  double resealing_time = 1.0;  ///< τ_res > τ_ep
};

/// Accuracy: implicit steps to rounding; X at a point in a varying potential to 1e-8
/// (tests/physics/poration_reaction_test.cpp)
/// Source: Kavian et al. 2014
class MembranePorosity : public PorationReaction {
 public:
  explicit MembranePorosity(const PorosityParameters& parameters) : p_(parameters) {}

  [[nodiscard]] double start() const override { return 0.0; }
  [[nodiscard]] Slope conductance(double porosity) const override;
  [[nodiscard]] double rate(double porosity, double potential) const override;
  [[nodiscard]] Slope implicit_step(double known, double dt, double potential) const override;
  [[nodiscard]] double damped_potential(double from, double to) const override;
  [[nodiscard]] double measure(double porosity) const override { return porosity; }
  [[nodiscard]] EffectDescription description() const override;

 private:
  /// β and dβ/dV.
  [[nodiscard]] Slope target(double potential) const;

  PorosityParameters p_;
};

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

/// g_p = 2π r² σ_p/(π r + 2h) of a pore of radius r through a membrane of thickness h: a cylinder in series with the
/// access resistance 1/(4rσ_p) of either end.
double pore_conductance(double radius, double thickness, double conductivity);
/// σ_p = (σ_e − σ_i)/ln(σ_e/σ_i) of a pore in which the conductivity varies linearly from one fluid to the other.
double pore_conductivity(double inside, double outside);

/// The state is s = ln(N/N_0), which is smooth where N rises by orders of magnitude within a few degrees of latitude; N
/// stays positive under truncation of s.
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
  [[nodiscard]] double damped_potential(double from, double to) const override;
  [[nodiscard]] double measure(double s) const override;
  [[nodiscard]] EffectDescription description() const override;

 private:
  PoreParameters p_;
};

EffectRow poration_row();

}  // namespace vehd

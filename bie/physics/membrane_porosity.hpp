#pragma once

#include "bie/physics/poration_reaction.hpp"

namespace vehd {

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
  [[nodiscard]] double limited(double from, double to) const override;
  [[nodiscard]] double measure(double porosity) const override { return porosity; }
  [[nodiscard]] EffectDescription description() const override;

 private:
  /// β with its slope by V.
  [[nodiscard]] Slope target(double potential) const;

  PorosityParameters p_;
};

}  // namespace vehd

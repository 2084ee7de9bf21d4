#pragma once

#include "bie/physics/effects/effect.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

/// Area A of a membrane under the mean tension σ = ∫λ dA/A:
///
/// α(σ) = A/A_0 − 1 = k_BT/(8πκ_c) ln(1 + c σ A_0/κ_c) + σ/K_A, c = 0.1.
///
/// At σ = −κ_c/(c A_0) the logarithm diverges and a compressed membrane buckles: the tension stays above this value at
/// any area.
/// Accuracy: rounding; `tension` and `area` are inverse to each other to 1e-12 (tests/physics/undulations_test.cpp)
/// Source: Evans and Rawicz 1990, with c of a closed vesicle
class AreaLaw {
 public:
  explicit AreaLaw(const Undulations& undulations);

  [[nodiscard]] double rest_area() const { return rest_area_; }
  /// A at a tension above least_tension().
  [[nodiscard]] double area(double tension) const;
  /// dA/dσ at a tension above least_tension().
  [[nodiscard]] double slope(double tension) const;
  /// Inverse of `area`, for every area > 0.
  [[nodiscard]] double tension(double area) const;
  /// −κ_c/(c A_0); −∞ without undulations.
  [[nodiscard]] double least_tension() const;

 private:
  double rest_area_;
  double logarithm_share_;  // k_BT/(8πκ_c)
  double per_tension_;      // c A_0/κ_c
  double stretch_;          // 1/K_A
};

/// The parameters with A_0: as given, or else so that the membrane has this area under the reference tension.
Undulations with_rest_area(Undulations undulations, double area);

EffectRow undulations_row();

}  // namespace vehd

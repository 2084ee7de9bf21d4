#pragma once

#include "bie/physics/effects/effect.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

/// Area A of a membrane under the mean tension σ = ∫λ dA/A:
///
/// α(σ) = A/A_0 − 1 = k_BT/(8πκ_c) ln(1 + c σ A_0/κ_c) + σ/K_A, c = 0.1.
///
/// At σ = −κ_c/(c A_0), where the logarithm diverges, a compressed membrane buckles: however small its area is, the
/// tension stays above.
/// Accuracy: rounding; tension and area are inverse to 1e-12 (tests/physics/undulations_test.cpp)
/// Source: Evans and Rawicz 1990, with c of a closed vesicle
class AreaLaw {
 public:
  explicit AreaLaw(const Undulations& undulations);

  [[nodiscard]] double rest_area() const { return rest_area_; }
  /// A of a tension above the least one.
  [[nodiscard]] double area(double tension) const;
  /// dA/dσ at a tension above the least one.
  [[nodiscard]] double slope(double tension) const;
  /// The inverse of `area`, of every area > 0.
  [[nodiscard]] double tension(double area) const;
  /// −κ_c/(c A_0); −∞ without undulations.
  [[nodiscard]] double least_tension() const;

 private:
  double rest_area_;
  double logarithm_share_;  // k_BT/(8πκ_c)
  double per_tension_;      // c A_0/κ_c
  double stretch_;          // 1/K_A
};

/// With A_0: the one that is given, or that of a membrane which has this area under the reference tension.
Undulations with_rest_area(Undulations undulations, double area);

EffectRow undulations_row();

}  // namespace vehd

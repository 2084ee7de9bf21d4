#include "bie/physics/effects/undulations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/physics/model.hpp"

namespace vehd {

namespace {

constexpr const char* kUndulations = "undulations";

/// c for a closed vesicle.
constexpr double closed_vesicle = 0.1;

}  // namespace

AreaLaw::AreaLaw(const Undulations& undulations)
    : rest_area_(undulations.rest_area),
      logarithm_share_(undulations.thermal_energy / (8.0 * std::numbers::pi * undulations.bending_rigidity)),
      per_tension_(closed_vesicle * undulations.rest_area / undulations.bending_rigidity),
      stretch_(undulations.stretching_modulus ? 1.0 / *undulations.stretching_modulus : 0.0) {}

double AreaLaw::area(double tension) const {
  const double logarithm = logarithm_share_ > 0.0 ? logarithm_share_ * std::log1p(per_tension_ * tension) : 0.0;
  return rest_area_ * (1.0 + logarithm + stretch_ * tension);
}

double AreaLaw::slope(double tension) const {
  return rest_area_ * (logarithm_share_ * per_tension_ / (1.0 + per_tension_ * tension) + stretch_);
}

double AreaLaw::tension(double area) const {
  const double strain = area / rest_area_ - 1.0;
  if (logarithm_share_ == 0.0) return strain / stretch_;
  if (stretch_ == 0.0) return std::expm1(strain / logarithm_share_) / per_tension_;
  // α = a s + b (e^s − 1) with s = ln(1 + c σ A_0/κ_c) increases with s and is convex: from above, Newton's method
  // decreases monotonically to the root.
  const double a = logarithm_share_, b = stretch_ / per_tension_;
  double s = strain > 0.0 ? std::min(strain / a, std::log1p(strain / b)) : 0.0;
  for (;;) {
    const double next = s - (a * s + b * std::expm1(s) - strain) / (a + b * std::exp(s));
    if (!(next < s)) return std::expm1(s) / per_tension_;
    s = next;
  }
}

double AreaLaw::least_tension() const {
  return logarithm_share_ > 0.0 ? -1.0 / per_tension_ : -std::numeric_limits<double>::infinity();
}

Undulations with_rest_area(Undulations undulations, double area) {
  if (undulations.rest_area > 0.0) return undulations;
  undulations.rest_area = area;
  // α depends on A_0 only through its logarithm: every pass gains two digits or more.
  constexpr int passes = 20;
  for (int pass = 0; pass < passes; ++pass) {
    undulations.rest_area *= area / AreaLaw(undulations).area(undulations.reference_tension);
  }
  return undulations;
}

EffectRow undulations_row() {
  return {kUndulations,
          [](const Model& model, const VesicleModel& vesicle) -> MadeEffect {
            if (!model.mobile || !vesicle.undulations) return nullptr;
            return described([] {
              return EffectDescription{
                  kUndulations, "the area follows the mean tension: div_gamma v is uniform instead of 0", {}, {}};
            });
          },
          [](Model&, VesicleModel& vesicle) { vesicle.undulations.reset(); }};
}

}  // namespace vehd

#include "fem_check/backward_differentiation.hpp"

#include <utility>

namespace vehd::fem_check {
namespace {

constexpr double implicit_share = 2.0 / 3.0;  ///< fraction of a step, for order 2

/// Stages y_1 = v + γΔt k_1 and y_2 = v + (1 − 2γ)Δt k_1 + γΔt k_2 with weights ½, ½ give order 2 for every γ.
Vector first_step(const TimeLaw& law, const Vector& start, const Vector& drift, double begin, double dt) {
  const double size = implicit_share * dt, between = (1.0 - 2.0 * implicit_share) * dt;
  const auto rate = [&](const Vector& from, double time) {
    return Vector((law.implicit(from + size * drift, size, time) - from) / size);
  };
  const Vector first = rate(start, begin + size);
  const Vector second = rate(start + between * first, begin + between + size);
  return start + 0.5 * dt * (first + second);
}

}  // namespace

double implicit_step(const TimeSteps& steps) { return implicit_share * (steps.end - steps.begin) / steps.number; }

Vector advance(const TimeLaw& law, const Vector& start, const TimeSteps& steps) {
  if (steps.number < 1) throw std::invalid_argument("the number of time steps must be at least 1");
  const double dt = (steps.end - steps.begin) / steps.number, size = implicit_step(steps);
  const auto drift_at = [&](const Vector& value, double time) {
    return law.explicit_rate ? law.explicit_rate(value, time) : Vector(Vector::Zero(value.size()));
  };
  Vector before = start, drift_before = drift_at(start, steps.begin);
  Vector now = first_step(law, start, drift_before, steps.begin, dt);
  for (int n = 1; n < steps.number; ++n) {
    Vector drift = drift_at(now, steps.begin + n * dt);
    const Vector from = (4.0 * now - before) / 3.0 + size * (2.0 * drift - drift_before);
    before = std::exchange(now, law.implicit(from, size, steps.begin + (n + 1) * dt));
    drift_before = std::move(drift);
  }
  return now;
}

}  // namespace vehd::fem_check

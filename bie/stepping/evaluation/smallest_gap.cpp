#include "bie/stepping/evaluation/smallest_gap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/potentials/nearest_points.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

double SmallestGap::degree() const { return relative > 0.0 ? thresholds::degrees_of_gap / std::sqrt(relative) : 0.0; }

SmallestGap find_smallest_gap(const State& state) {
  if (state.vesicles.size() < 2) return {};
  std::vector<Matrix> membranes;
  for (const VesicleState& vesicle : state.vesicles) membranes.push_back(vesicle.position);
  const auto [first, second, points] = closest_pair(membranes);
  const double area = std::min(state.vesicles[first].reference_area, state.vesicles[second].reference_area);
  const double radius = std::sqrt(area / (4.0 * std::numbers::pi));
  return {points.gap, points.gap / radius, radius, first, second, 0.5 * (points.on_first + points.on_second)};
}

void require_gap(const SmallestGap& gap, const SmallestGap& before, double spacing, const Frame& frame,
                 const std::vector<std::string>& names) {
  const bool touches = gap.relative < thresholds::smallest_gap;
  const bool jumps =
      std::isfinite(before.relative) && gap.relative < std::min(spacing, thresholds::least_approach * before.relative);
  if (!touches && !jumps) return;
  const auto name = [&](std::size_t a) { return names.empty() ? fmt::format("{}", a) : names[a]; };
  constexpr double kRounding = 1e-6;
  const Vector3 place = (frame.origin + frame.axes * gap.place).unaryExpr([&](double x) {
    return std::abs(x) < kRounding * gap.radius ? 0.0 : x;
  });
  const std::string where =
      fmt::format("vesicles \"{}\" and \"{}\" come within {:.2g} radii of each other at ({:.3g}, {:.3g}, {:.3g})",
                  name(gap.first), name(gap.second), std::max(gap.relative, 0.0), place.x(), place.y(), place.z());
  if (touches) {
    throw ConvergenceError(fmt::format("{}; accepted: {:g}, up to which the layers between them are exact", where,
                                       thresholds::smallest_gap));
  }
  throw ConvergenceError(fmt::format("{} in one step, from {:.2g}", where, before.relative));
}

}  // namespace vehd

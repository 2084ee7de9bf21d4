#include "bie/stepping/evaluation/smallest_gap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/potentials/nearest_points.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

double radius_of(double area) { return std::sqrt(area / (4.0 * std::numbers::pi)); }

SmallestGap between_vesicles(const State& state) {
  if (state.vesicles.size() < 2) return {};
  std::vector<Matrix> membranes;
  for (const VesicleState& vesicle : state.vesicles) membranes.push_back(vesicle.position);
  const auto [first, second, points] = closest_pair(membranes);
  const double area = std::min(state.vesicles[first].reference_area, state.vesicles[second].reference_area);
  const double radius = radius_of(area);
  return {points.gap, points.gap / radius, radius, first, second, 0.5 * (points.on_first + points.on_second)};
}

}  // namespace

double SmallestGap::degree() const {
  const double between_membranes = to_wall ? 2.0 * relative : relative;
  return relative > 0.0 ? thresholds::degrees_of_gap / std::sqrt(between_membranes) : 0.0;
}

SmallestGap find_smallest_gap(const State& state, const Discretisation& discretisation,
                              const std::optional<Wall>& wall) {
  SmallestGap smallest = between_vesicles(state);
  for (std::size_t a = 0; wall && a < state.vesicles.size(); ++a) {
    const auto [distance, place] =
        nearest_to_wall(*wall, discretisation.vesicle(a).fine_transform(), state.vesicles[a].position);
    if (distance >= smallest.distance) continue;
    const double radius = radius_of(state.vesicles[a].reference_area);
    smallest = {distance, distance / radius, radius, a, a, place - 0.5 * distance * wall->normal, true};
  }
  return smallest;
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
  const std::string who = !gap.to_wall
                              ? fmt::format("vesicles \"{}\" and \"{}\" come", name(gap.first), name(gap.second))
                          : names.empty() ? "the vesicle comes"
                                          : fmt::format("vesicle \"{}\" comes", name(gap.first));
  const std::string where =
      fmt::format("{} within {:.2g} radii of {} at ({:.3g}, {:.3g}, {:.3g})", who, std::max(gap.relative, 0.0),
                  gap.to_wall ? "the wall" : "each other", place.x(), place.y(), place.z());
  if (touches) {
    throw ConvergenceError(fmt::format("{}; accepted: {:g}, up to which the layers between them are exact", where,
                                       thresholds::smallest_gap));
  }
  throw ConvergenceError(fmt::format("{} in one step, from {:.2g}", where, before.relative));
}

}  // namespace vehd

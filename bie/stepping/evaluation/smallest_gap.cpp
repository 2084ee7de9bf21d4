#include "bie/stepping/evaluation/smallest_gap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bie/potentials/nearest_points.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Gaps up to this many radii are searched for the degree that they require: wider ones need none above the lowest.
constexpr double widest_gap = 2.0;

/// The gaps between close vesicles, and those of all vesicles to the wall.
std::vector<SmallestGap> all_gaps(const State& state, const Discretisation& discretisation,
                                  const std::optional<Wall>& wall) {
  std::vector<Matrix> membranes;
  double largest = 0.0;
  for (const VesicleState& vesicle : state.vesicles) {
    membranes.push_back(vesicle.position);
    largest = std::max(largest, vesicle.radius());
  }
  std::vector<SmallestGap> gaps;
  for (const auto& [first, second, points] : close_pairs(membranes, widest_gap * largest)) {
    const double radius = std::min(state.vesicles[first].radius(), state.vesicles[second].radius());
    const Vector3 middle = 0.5 * (points.on_first + points.on_second);
    gaps.push_back({points.gap, points.gap / radius, radius, first, second, middle});
  }
  for (std::size_t a = 0; wall && a < state.vesicles.size(); ++a) {
    const auto [distance, place] =
        nearest_to_wall(*wall, discretisation.vesicle(a).fine_transform(), state.vesicles[a].position);
    const double radius = state.vesicles[a].radius();
    gaps.push_back({distance, distance / radius, radius, a, a, place - 0.5 * distance * wall->normal, true});
  }
  return gaps;
}

/// Degree that densities in this gap require: the wall is half way to the image.
double degree_in(const SmallestGap& gap, double tolerance) {
  const double between_membranes = gap.to_wall ? 2.0 * gap.relative : gap.relative;
  return between_membranes > 0.0 ? thresholds::degrees_of_gap(tolerance) / std::sqrt(between_membranes) : 0.0;
}

}  // namespace

double SmallestGap::degree() const { return degrees.empty() ? 0.0 : std::ranges::max(degrees); }

SmallestGap find_smallest_gap(const State& state, const Discretisation& discretisation, const std::optional<Wall>& wall,
                              double tolerance) {
  SmallestGap smallest;
  std::vector<double> degrees(state.vesicles.size(), 0.0);
  for (const SmallestGap& gap : all_gaps(state, discretisation, wall)) {
    if (gap.distance < smallest.distance) smallest = gap;
    for (const std::size_t a : {gap.first, gap.second}) degrees[a] = std::max(degrees[a], degree_in(gap, tolerance));
  }
  smallest.degrees = std::move(degrees);
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
    throw ConvergenceError(fmt::format("{}; accepted: at least {:g}, the smallest gap for which the layers are tested",
                                       where, thresholds::smallest_gap));
  }
  throw ConvergenceError(fmt::format("{} in one step, from {:.2g}", where, before.relative));
}

}  // namespace vehd

#include "bie/potentials/near_rule.hpp"

#include <algorithm>
#include <cmath>

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

constexpr double kNodeGrowth = 1.25;
/// Finest grading, t = 2^−50: beyond it every distance is rounding.
constexpr int kFinestLevel = 50;

/// As make_graded_rule needs it.
int multiple_of_four(double n) { return 4 * static_cast<int>(std::ceil(0.25 * n)); }
int least_n_theta(int order, int level) { return static_cast<int>(std::ceil(1.15 * order)) + 8 + level; }
int least_n_phi(int order) { return 2 * order + 12; }

/// Levels of the azimuthal ladder above the least node count: along a circle about the pole |x − y| oscillates with the
/// ratio of the stretches, and the trapezoidal rule gains the factor (a + b)/(a − b) with every two nodes.
int azimuth_level(const FootPoint& foot, int least, double tolerance) {
  constexpr int kHighest = 5;
  const double gain =
      (foot.largest_stretch + foot.smallest_stretch) / (foot.largest_stretch - foot.smallest_stretch + 1e-300);
  const double needed = 2.0 * std::log(1.0 / tolerance) / std::log(std::max(gain, 1.0 + 1e-6));
  return std::clamp(static_cast<int>(std::ceil(std::log(needed / least) / std::log(kNodeGrowth))), 0, kHighest);
}

}  // namespace

NearRule near_rule(const FootPoint& foot, int order, double tolerance, bool on_membrane) {
  NearRule choice;
  if (!on_membrane) {
    const double ratio = foot.largest_stretch / std::abs(foot.height);
    choice.level = std::clamp(static_cast<int>(std::ceil(std::log2(std::max(ratio, 1.0)))), 0, kFinestLevel);
  }
  choice.azimuth = azimuth_level(foot, least_n_phi(order), tolerance);
  return choice;
}

GradedRule make_near_rule(int order, const NearRule& choice, int stage) {
  return make_graded_rule(order, std::exp2(-choice.level),
                          multiple_of_four(least_n_theta(order, choice.level) * std::pow(kNodeGrowth, stage)),
                          multiple_of_four(least_n_phi(order) * std::pow(kNodeGrowth, choice.azimuth + stage)));
}

FootPoint nearest_foot(const Matrix& position, const SmoothGrid& grid, const NearestNodes& nearest,
                       const Vector3& point) {
  const auto from = [&](Index node) { return find_foot_point(position, grid.directions.row(node).transpose(), point); };
  FootPoint foot = from(nearest.first);
  if (nearest.opposite_counts) {
    const FootPoint opposite = from(nearest.opposite);
    if (std::abs(opposite.height) < std::abs(foot.height)) foot = opposite;
  }
  return foot;
}

std::vector<FootPoint> nearest_feet(const Matrix& position, const SmoothGrid& grid,
                                    const std::vector<NearestNodes>& nearest, const Matrix& targets) {
  require_size("nearest nodes", static_cast<long>(nearest.size()), targets.rows());
  std::vector<Index> nodes, of_targets;
  const auto seek = [&](Index target, Index node) {
    nodes.push_back(node);
    of_targets.push_back(target);
  };
  for (Index i = 0; i < targets.rows(); ++i) {
    const NearestNodes& from = nearest[static_cast<std::size_t>(i)];
    seek(i, from.first);
    if (from.opposite_counts) seek(i, from.opposite);
  }
  const std::vector<FootPoint> found =
      find_foot_points(position, grid.directions(nodes, Eigen::all), targets(of_targets, Eigen::all));
  std::vector<FootPoint> feet;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (k == 0 || of_targets[k] != of_targets[k - 1]) {
      feet.push_back(found[k]);
    } else if (std::abs(found[k].height) < std::abs(feet.back().height)) {
      feet.back() = found[k];
    }
  }
  return feet;
}

}  // namespace vehd

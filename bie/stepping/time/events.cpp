#include "bie/stepping/time/events.hpp"

#include <algorithm>
#include <cmath>

namespace vehd {

namespace {

/// Rounding of multiples of a spacing of snapshots, over the spacing.
constexpr double rounding = 1e-9;
/// Relative rounding of a time that is listed.
constexpr double rounding_of_time = 1e-12;

/// Index of the first of k * every that is later than the time.
double index_after(double time, double every) { return std::floor(time / every + rounding) + 1.0; }

}  // namespace

std::optional<double> SnapshotTimes::next(double time, double end) const {
  std::optional<double> earliest;
  const auto consider = [&](double moment, double tolerance) {
    if (moment < end - tolerance && (!earliest || moment < *earliest)) earliest = moment;
  };
  if (every) consider(index_after(time, *every) * *every, rounding * *every);
  const auto listed = std::ranges::partition_point(times, [&](double moment) {
    return moment - time <= rounding_of_time * std::max(std::abs(moment), std::abs(time));
  });
  if (listed != times.end()) consider(*listed, rounding_of_time * *listed);
  for (const SnapshotWindow& window : windows) {
    const double moment = window.from + std::max(0.0, index_after(time - window.from, window.every)) * window.every;
    const double tolerance = rounding * window.every;
    // The start has a snapshot anyway: a window that begins there does not repeat it.
    if (moment - time > tolerance && moment <= window.to + tolerance) consider(moment, tolerance);
  }
  return earliest;
}

std::vector<double> SnapshotTimes::between(double from, double to) const {
  std::vector<double> moments;
  for (auto moment = next(from, to); moment; moment = next(*moment, to)) moments.push_back(*moment);
  return moments;
}

bool SnapshotTimes::is_due(double time, double from, double end) const {
  const std::vector<double> before = between(from, time);
  const auto moment = next(before.empty() ? from : before.back(), end);
  const auto later = next(time, end);
  return moment && (!later || *moment < *later);
}

double SnapshotTimes::count(double end) const {
  double count = every ? end / *every : 0.0;
  count += static_cast<double>(std::ranges::count_if(times, [&](double moment) { return moment < end; }));
  for (const SnapshotWindow& window : windows) {
    count += std::max(0.0, std::min(window.to, end) - window.from) / window.every;
  }
  return count;
}

}  // namespace vehd

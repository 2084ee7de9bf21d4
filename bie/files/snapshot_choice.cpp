#include "bie/files/snapshot_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Distance of a snapshot to its neighbour on the side of the time or, at an end, to its only one; 0 if it has none.
double spacing_at(const std::vector<double>& times, std::size_t snapshot, double time) {
  const std::size_t last = times.size() - 1;
  if (last == 0) return 0.0;
  const std::size_t right = std::clamp<std::size_t>(time < times[snapshot] ? snapshot : snapshot + 1, 1, last);
  return times[right] - times[right - 1];
}

}  // namespace

std::string shown_time(double time, const SiUnit& unit) {
  const std::string number = fmt::format("{:.10g}", time * unit.scale);
  return unit.symbol == "1" ? number : number + " " + unit.symbol;
}

SnapshotChoice choose_snapshot(const RunReader& run, const std::filesystem::path& file, std::optional<double> time,
                               const SiUnit& shown) {
  // Times of snapshots are multiples of a decimal number up to rounding.
  constexpr double kSameTime = 1e-9;
  const std::vector<double>& times = run.times();
  if (!time) return {times.size() - 1, ""};
  const std::size_t snapshot = run.nearest(*time);
  const double spacing = spacing_at(times, snapshot, *time);
  const double distance = std::abs(times[snapshot] - *time);
  const auto text = [&shown](double of) { return shown_time(of, shown); };
  const double same = kSameTime * std::max(spacing, std::abs(*time));
  if (distance <= same) return {snapshot, ""};
  // Written so that a time which is not a number is refused.
  if (!(distance <= 0.5 * spacing + same)) {
    throw InputError(fmt::format("{}: no snapshot near time {}; there are {} from {} to {}, the nearest at {}",
                                 file.string(), text(*time), times.size(), text(times.front()), text(times.back()),
                                 text(times[snapshot])));
  }
  return {snapshot, fmt::format("{}: no snapshot at time {}; taken: the nearest, at {}", file.string(), text(*time),
                                text(times[snapshot]))};
}

}  // namespace vehd

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "bie/files/run_reader.hpp"
#include "bie/files/si_unit.hpp"

namespace vehd {

/// The snapshot that stands for a time which was asked for.
struct SnapshotChoice {
  std::size_t snapshot = 0;
  std::string note;  ///< which other time it has; empty if it has that very time
};

/// A time of a run in a unit, as messages write it and as it may be given.
std::string shown_time(double time, const SiUnit& unit);

/// The nearest snapshot, provided that it is not farther than half the distance of neighbouring snapshots there: any
/// time within a run has one, a time well before or after has none. Without a time, the last snapshot.
/// @param file  that `run` was read from, for messages
/// @param shown  unit of the times in messages
/// @throws InputError naming the times between which the snapshots are, and the nearest one
SnapshotChoice choose_snapshot(const RunReader& run, const std::filesystem::path& file, std::optional<double> time,
                               const SiUnit& shown = {});

}  // namespace vehd

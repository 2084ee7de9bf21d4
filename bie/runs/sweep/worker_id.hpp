#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vehd {

/// A process as every machine of a cluster can name it.
struct WorkerId {
  std::string host;
  std::string boot;   ///< of that machine, beginning of its id: the same name may be a machine that was started anew
  std::string space;  ///< of process numbers: those of a container are its own
  std::int64_t process = 0;
  std::uint64_t start = 0;  ///< when it began, as the system counts: process numbers come again
  bool operator==(const WorkerId&) const = default;
};

/// This process.
WorkerId this_worker();

/// As part of a file's name: "host@boot@space@process@start".
std::string text_of(const WorkerId& worker);
/// nullopt of anything else.
std::optional<WorkerId> worker_of(std::string_view text);

/// Whether this process can see all processes among which the worker is, so that one it does not see has ended.
bool is_in_sight(const WorkerId& worker);
/// Whether a worker in sight still lives. What has ended and was not yet waited for does not.
bool lives(const WorkerId& worker);

}  // namespace vehd

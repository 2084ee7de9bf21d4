#pragma once

#include <string>
#include <vector>

namespace vehd {

/// Communication between the processes of one run; all calls are collective.
class RankLink {
 public:
  virtual ~RankLink() = default;
  /// Number of this process, from 0.
  [[nodiscard]] virtual int rank() const = 0;
  /// Number of processes.
  [[nodiscard]] virtual int size() const = 0;
  /// Values of all ranks, of any length, in the order of ranks.
  virtual std::vector<std::string> gather(const std::string& own) = 0;
  /// Sends `to[r]` to rank r.
  /// @return the messages of all ranks to this one
  virtual std::vector<std::string> exchange(const std::vector<std::string>& to) = 0;
};

}  // namespace vehd

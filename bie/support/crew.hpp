#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <vector>

namespace vehd {

/// Copies of this process that work side by side. They end when this process does: each is told by SIGTERM.
///
/// A copy has everything that this process has read and computed so far; what it changes, it changes for itself. To be
/// used by a process of one thread.
class Crew {
 public:
  /// Work of a copy: from its number to its exit code (0 ... 255).
  using Work = std::function<int(int)>;

  explicit Crew(Work work) : work_(std::move(work)) {}
  /// Tells those that still work to end, and waits for them.
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Starts a copy.
  /// @throws OutputError if the system has no room for one
  void start(int number);

  /// How a copy has ended.
  struct End {
    int number = 0;
    int exit_code = 0;
    int signal = 0;  ///< that ended it, if one did
  };
  /// One that has ended since the last call.
  std::optional<End> next_end();

  [[nodiscard]] std::size_t n_working() const { return copies_.size(); }
  /// Sends SIGTERM to all.
  void stop() const;

 private:
  struct Copy {
    pid_t process;
    int number;
  };
  Work work_;
  std::vector<Copy> copies_;
};

}  // namespace vehd

#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <vector>

namespace vehd {

/// Forked copies of this process that work concurrently. Each receives SIGTERM when this process ends.
///
/// A copy starts with all data that this process has read and computed so far; its changes stay in the copy. This
/// process must have one thread.
class WorkerPool {
 public:
  /// Work of a copy: maps its number to its exit code (0 ... 255).
  using Work = std::function<int(int)>;

  explicit WorkerPool(Work work) : work_(std::move(work)) {}
  /// Sends SIGTERM to the copies that still work, and waits for them.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Starts a copy.
  /// @throws OutputError if the system cannot start another process
  void start(int number);

  /// Outcome of a copy.
  struct End {
    int number = 0;
    int exit_code = 0;
    int signal = 0;  ///< that ended it; 0: none
  };
  /// Outcome of a copy that has ended and has not been returned before.
  std::optional<End> next_end();

  [[nodiscard]] std::size_t n_working() const { return copies_.size(); }
  /// Sends SIGTERM to all copies.
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

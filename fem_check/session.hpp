#pragma once

#include <memory>

namespace vehd::fem_check {

/// MPI and the libraries under deal.II, from construction to destruction; one per process, first thing in main.
/// Every rank runs on one thread.
class Session {
 public:
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Number of this process.
  [[nodiscard]] int rank() const;
  /// Number of processes.
  [[nodiscard]] int n_ranks() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vehd::fem_check

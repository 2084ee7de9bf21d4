#pragma once

#include <memory>

namespace vehd::fem_check {

/// MPI and the libraries under deal.II, from construction to destruction; one per process, first thing in main.
/// Every rank runs on one thread. None of them sees the arguments of the program: PETSc would take them for its own.
class Session {
 public:
  Session();
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

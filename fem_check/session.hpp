#pragma once

#include <memory>

namespace vehd::fem_check {

/// Initialises MPI and the libraries that deal.II uses, and finalises them on destruction; one per process, at the
/// start of main. Every rank runs on one thread. The program's arguments are not passed on: PETSc would interpret them.
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

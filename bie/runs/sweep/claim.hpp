#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "bie/runs/sweep/worker_id.hpp"

/// Who works at which run of a sweep.
///
/// Every run directory holds one file whose name says so: claim.free, claim.held with the worker and the number of
/// takeovers, claim.done or claim.crashed with the signal. A claim changes by renaming that file: of several workers
/// that try at once, also on different machines of a shared file system, one succeeds and the others find the old name
/// gone. A new directory is renamed into its place with the claim in it, so that there is none without.
///
/// A claim whose worker has ended goes to the next that asks. On the machine of that worker the process table tells
/// whether it has ended. Elsewhere the time of the claim tells, which its worker renews: it counts as ended after
/// the patience of ClaimTimes, by the clock of the file system, so that clocks of machines need not agree.
namespace vehd {

/// When a worker says that it lives, and when others stop believing it.
struct ClaimTimes {
  std::chrono::seconds beat{20};
  /// Network file systems show the time of a file up to a minute late; a dozen missed beats are no accident.
  std::chrono::seconds patience{300};
};

/// What the claim file of a run directory says.
struct ClaimState {
  enum class Kind { absent, free, held, done, crashed, unknown };
  Kind kind = Kind::absent;  ///< absent: there is no directory; unknown: no claim was seen in it
  std::string name{};        ///< of the file
  WorkerId worker{};         ///< that holds it
  int takeovers = 0;         ///< from workers that ended while they held it, in a row
  int signal = 0;            ///< of a crash
};

/// @param directory  of a run
ClaimState claim_state(const std::filesystem::path& directory);

/// A run that belongs to this process until it is given back.
class Claim {
 public:
  Claim(std::filesystem::path directory, std::string name) : directory_(std::move(directory)), name_(std::move(name)) {}

  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }
  [[nodiscard]] std::filesystem::path file() const { return directory_ / name_; }
  /// Beginning of the name that the claim gets by a crash.
  [[nodiscard]] std::filesystem::path crash_stem() const { return directory_ / "claim.crashed."; }
  /// Nothing is left to do for anybody.
  void finish() const;
  /// Another worker may go on.
  void release() const;

 private:
  std::filesystem::path directory_;
  std::string name_;
};

/// The claims of one worker.
class Claims {
 public:
  /// @param runs  the folder of run directories
  /// @throws OutputError if it cannot be made
  explicit Claims(std::filesystem::path runs, ClaimTimes times = {});

  /// Claims a run unless somebody else has it, or it is done. @throws OutputError if the folder cannot be written
  std::optional<Claim> take(const std::string& run) const;
  /// Removes directories that workers which have ended could not put into their places any more.
  void tidy() const;
  [[nodiscard]] const std::filesystem::path& runs() const { return runs_; }
  [[nodiscard]] const ClaimTimes& times() const { return times_; }

  /// A run whose workers were ended so often, one after the other, is what ends them.
  static constexpr int most_takeovers = 20;

 private:
  [[nodiscard]] std::optional<Claim> create(const std::string& run) const;
  [[nodiscard]] std::optional<Claim> rename(const std::filesystem::path& directory, const std::string& from,
                                            const std::string& to) const;
  [[nodiscard]] bool has_ended(const WorkerId& worker, const std::filesystem::path& claim) const;

  std::filesystem::path runs_;
  ClaimTimes times_;
  std::string me_;
};

}  // namespace vehd

#include "bie/runs/sweep/claim.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>

#include "bie/support/file_system.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view free_claim = "claim.free", done_claim = "claim.done", held_claim = "claim.held@",
                           crashed_claim = "claim.crashed.";

int number_in(std::string_view text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

ClaimState state_of(const std::string& name) {
  using Kind = ClaimState::Kind;
  if (name == free_claim) return {Kind::free, name};
  if (name == done_claim) return {Kind::done, name};
  ClaimState state{Kind::unknown, name};
  if (name.starts_with(crashed_claim)) {
    state.kind = Kind::crashed;
    state.signal = number_in(std::string_view(name).substr(crashed_claim.size()));
  } else if (name.starts_with(held_claim)) {
    const std::size_t last = name.rfind('@');
    const auto worker = worker_of(std::string_view(name).substr(held_claim.size(), last - held_claim.size()));
    if (worker) {
      state.kind = Kind::held;
      state.worker = *worker;
      state.takeovers = number_in(std::string_view(name).substr(last + 1));
    }
  }
  return state;
}

std::string held_by(const std::string& worker, int takeovers) {
  return fmt::format("{}{}@{}", held_claim, worker, takeovers);
}

void make_empty_file(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) throw OutputError(write_problem(path));
  ::close(descriptor);
}

/// Seconds of the clock of the file system at which a file was changed last. Opening it asks the server.
std::optional<double> time_of(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return std::nullopt;
  struct stat facts {};
  const bool known = ::fstat(descriptor, &facts) == 0;
  ::close(descriptor);
  if (!known) return std::nullopt;
  return static_cast<double>(facts.st_mtim.tv_sec) + 1e-9 * static_cast<double>(facts.st_mtim.tv_nsec);
}

void require_renamed(const fs::path& from, const fs::path& to) {
  // Gone: another worker has taken the claim for one of the dead.
  if (std::rename(from.c_str(), to.c_str()) != 0 && errno != ENOENT) throw OutputError(write_problem(to));
}

}  // namespace

ClaimState claim_state(const fs::path& directory) {
  std::error_code error;
  fs::directory_iterator entries(directory, error);
  if (error) return {};
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("claim.")) return state_of(name);
  }
  return {ClaimState::Kind::unknown};
}

void Claim::finish() const { require_renamed(file(), directory_ / done_claim); }

void Claim::release() const { require_renamed(file(), directory_ / free_claim); }

Claims::Claims(fs::path runs, ClaimTimes times) : runs_(std::move(runs)), times_(times), me_(text_of(this_worker())) {
  make_directory(runs_);
}

std::optional<Claim> Claims::take(const std::string& run) const {
  const fs::path directory = runs_ / run;
  const ClaimState state = claim_state(directory);
  switch (state.kind) {
    case ClaimState::Kind::absent:
      return create(run);
    case ClaimState::Kind::free:
      return rename(directory, state.name, held_by(me_, 0));
    case ClaimState::Kind::held:
      break;
    default:
      return std::nullopt;
  }
  if (!has_ended(state.worker, directory / state.name)) return std::nullopt;
  if (state.takeovers < most_takeovers) return rename(directory, state.name, held_by(me_, state.takeovers + 1));
  constexpr int killed = 9;
  static_cast<void>(rename(directory, state.name, fmt::format("{}{}", crashed_claim, killed)));
  return std::nullopt;
}

std::optional<Claim> Claims::create(const std::string& run) const {
  const fs::path made = runs_ / fmt::format(".{}.{}", run, me_), directory = runs_ / run;
  const std::string name = held_by(me_, 0);
  make_directory(made);
  make_empty_file(made / name);
  // An empty directory would be replaced; any other makes this fail.
  if (std::rename(made.c_str(), directory.c_str()) == 0) return Claim(directory, name);
  const int problem = errno;
  std::error_code ignored;
  fs::remove_all(made, ignored);
  if (problem != EEXIST && problem != ENOTEMPTY) {
    errno = problem;
    throw OutputError(write_problem(directory));
  }
  return std::nullopt;
}

std::optional<Claim> Claims::rename(const fs::path& directory, const std::string& from, const std::string& to) const {
  // First: under the new name the claim must never look as old as that of the last worker.
  ::utimensat(AT_FDCWD, (directory / from).c_str(), nullptr, 0);
  if (std::rename((directory / from).c_str(), (directory / to).c_str()) != 0) {
    if (errno != ENOENT) throw OutputError(write_problem(directory / to));
    // A network file system may say so although an earlier try of its own has succeeded.
    std::error_code ignored;
    if (!fs::exists(directory / to, ignored)) return std::nullopt;
  }
  return Claim(directory, to);
}

bool Claims::has_ended(const WorkerId& worker, const fs::path& claim) const {
  if (is_in_sight(worker)) return !lives(worker);
  const fs::path clock = runs_ / fmt::format(".now.{}", me_);
  make_empty_file(clock);
  ::utimensat(AT_FDCWD, clock.c_str(), nullptr, 0);
  const auto now = time_of(clock), last = time_of(claim);
  std::error_code ignored;
  fs::remove(clock, ignored);
  return now && last && *now - *last > static_cast<double>(times_.patience.count());
}

void Claims::tidy() const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(runs_, error)) {
    const std::string name = entry.path().filename().string();
    const std::size_t worker = name.find('.', 1);
    if (!name.starts_with('.') || worker == std::string::npos) continue;
    const auto owner = worker_of(std::string_view(name).substr(worker + 1));
    std::error_code ignored;
    if (owner && has_ended(*owner, entry.path())) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace vehd

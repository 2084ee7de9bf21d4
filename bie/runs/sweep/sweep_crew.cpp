#include "bie/runs/sweep/sweep_crew.hpp"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <numeric>
#include <set>
#include <thread>

#include "bie/runs/sweep/run_result.hpp"
#include "bie/support/crew.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/output_error.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
namespace {

constexpr std::chrono::milliseconds look_interval{10};
/// Workers that end before they have finished a run, one after the other: something ends them all.
constexpr int most_vain_starts = 100;

/// Boards that this process shares with its copies.
class SharedBoards {
 public:
  explicit SharedBoards(int count) : bytes_(static_cast<std::size_t>(count) * sizeof(WorkerBoard)) {
    place_ = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (place_ == MAP_FAILED) throw std::bad_alloc();
    // The pages are zero, which is what a board begins with.
    for (int i = 0; i < count; ++i) new (&at(i)) WorkerBoard{};
  }
  ~SharedBoards() { ::munmap(place_, bytes_); }
  SharedBoards(const SharedBoards&) = delete;
  SharedBoards& operator=(const SharedBoards&) = delete;

  [[nodiscard]] WorkerBoard& at(int i) const { return static_cast<WorkerBoard*>(place_)[i]; }

 private:
  std::size_t bytes_;
  void* place_;
};

static_assert(std::atomic<double>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class SweepCrew {
 public:
  SweepCrew(const CrewTask& task, Interruption& interruption)
      : task_(task),
        interruption_(interruption),
        boards_(task.n_workers),
        crew_([this](int number) { return work(number); }) {
    std::set<std::string> names;
    for (const SweepRun& run : task.runs) {
      if (run.scene) names.insert(run.name);
    }
    status_.n_runs = std::ssize(names);
    for (const std::string& name : names) n_before_ += has_result(task.paths.runs() / name) ? 1 : 0;
    status_.start_share = share_of(static_cast<double>(n_before_));
  }

  CrewOutcome run() {
    Claims(task_.paths.runs()).tidy();
    for (int i = 0; i < task_.n_workers; ++i) start(i);
    while (crew_.n_working() > 0) {
      while (const auto end = crew_.next_end()) answer(*end);
      if (!outcome_.interrupted && interruption_.requested()) stop();
      tell();
      std::this_thread::sleep_for(look_interval);
    }
    for (int i = 0; i < task_.n_workers; ++i) outcome_.run_seconds += boards_.at(i).run_seconds;
    return outcome_;
  }

 private:
  void start(int number) {
    started_[static_cast<std::size_t>(number)] = Clock::now();
    crew_.start(number);
  }

  /// In a copy of this process.
  int work(int number) {
    const ThreadCount threads(task_.n_threads);
    const WorkerEnd end = work_at_sweep(task_.sweep, task_.runs, order_of_worker(number), task_.paths.runs(),
                                        interruption_, boards_.at(number));
    return static_cast<int>(end);
  }

  /// Each worker begins elsewhere, so that they do not all ask for the same run.
  [[nodiscard]] std::vector<std::size_t> order_of_worker(int number) const {
    std::vector<std::size_t> order = task_.order;
    const auto n = static_cast<std::size_t>(task_.n_workers);
    if (order.size() > n) std::rotate(order.begin(), order.begin() + number, order.end());
    return order;
  }

  void answer(const Crew::End& end) {
    WorkerBoard& board = boards_.at(end.number);
    board.share = 0.0;
    outcome_.worker_seconds += seconds_since(started_[static_cast<std::size_t>(end.number)]);
    if (outcome_.interrupted) return;
    const bool by_itself = end.signal == 0;
    if (by_itself && end.exit_code == static_cast<int>(WorkerEnd::nothing_left)) return;
    if (by_itself && end.exit_code == static_cast<int>(WorkerEnd::cannot_write)) {
      outcome_.problem = board.problem.data();
      return stop();
    }
    // A signal to all of us, or to this worker alone.
    if (by_itself && interruption_.requested()) return stop();
    const std::int64_t finished = n_finished();
    n_vain_starts_ = finished == n_finished_at_start_ ? n_vain_starts_ + 1 : 0;
    n_finished_at_start_ = finished;
    if (n_vain_starts_ > most_vain_starts) {
      outcome_.problem = fmt::format("{} workers in a row were ended before one had finished a run", n_vain_starts_);
      return stop();
    }
    start(end.number);
  }

  void stop() {
    outcome_.interrupted = true;
    crew_.stop();
  }

  [[nodiscard]] std::int64_t n_finished() const {
    std::int64_t count = 0;
    for (int i = 0; i < task_.n_workers; ++i) count += boards_.at(i).n_finished;
    return count;
  }

  [[nodiscard]] double share_of(double n) const {
    return status_.n_runs == 0 ? 1.0 : n / static_cast<double>(status_.n_runs);
  }

  void tell() {
    if (!task_.tell) return;
    double in_hand = 0.0;
    for (int i = 0; i < task_.n_workers; ++i) in_hand += boards_.at(i).share;
    status_.n_finished = n_before_ + n_finished();
    status_.share = share_of(static_cast<double>(status_.n_finished) + in_hand);
    status_.seconds = seconds_since(start_);
    task_.tell(status_);
  }

  const CrewTask& task_;
  Interruption& interruption_;
  SharedBoards boards_;
  Crew crew_;
  CrewStatus status_;
  CrewOutcome outcome_;
  std::int64_t n_before_ = 0, n_finished_at_start_ = 0;
  int n_vain_starts_ = 0;
  std::vector<Clock::time_point> started_ = std::vector<Clock::time_point>(static_cast<std::size_t>(task_.n_workers));
  Clock::time_point start_ = Clock::now();
};

}  // namespace

CrewOutcome work_as_crew(const CrewTask& task, Interruption& interruption) {
  return SweepCrew(task, interruption).run();
}

}  // namespace vehd

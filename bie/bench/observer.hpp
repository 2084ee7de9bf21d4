#pragma once

#include <string>
#include <vector>

#include "bie/bench/table.hpp"
#include "bie/runs/run_status.hpp"

namespace vehd {

/// Observer of a bench, called as soon as there is a result.
class BenchObserver {
 public:
  virtual ~BenchObserver() = default;

  /// One of several benches begins.
  virtual void section(const std::string& title) = 0;
  /// A line for people.
  virtual void note(const std::string& line) = 0;
  /// Something beside the numbers is missing.
  virtual void warn(const std::string& problem) = 0;
  /// A table begins.
  virtual void heading(const BenchTable& table) = 0;
  /// A row of the table is known.
  virtual void row(const BenchTable& table, const std::vector<BenchCell>& row) = 0;
  /// A task begins, the first with number 1.
  virtual void task(int number, int n_tasks, const std::string& what) = 0;
  /// A run within a task has taken a step.
  virtual void status(const RunStatus& status) = 0;
};

/// Counts the tasks of one bench.
class BenchTasks {
 public:
  BenchTasks(int n_tasks, BenchObserver& observer) : n_tasks_(n_tasks), observer_(observer) {}

  /// The next task begins.
  void next(const std::string& what) { observer_.task(++n_begun_, n_tasks_, what); }

 private:
  int n_tasks_;
  int n_begun_ = 0;
  BenchObserver& observer_;
};

}  // namespace vehd

#pragma once

#include "bie/bench/result.hpp"
#include "bie/support/progress.hpp"

namespace vehd {

/// Prints results of benches on standard output, progress on standard error.
class BenchPrinter : public BenchObserver {
 public:
  void section(const std::string& title) override;
  void note(const std::string& line) override;
  void warn(const std::string& problem) override;
  void heading(const BenchTable& table) override;
  void row(const BenchTable& table, const std::vector<BenchCell>& row) override;
  void task(int number, int n_tasks, const std::string& what) override;
  void status(const RunStatus& status) override;

 private:
  void print(const std::string& text);

  Progress progress_{Progress::suitable_style()};
};

}  // namespace vehd

#include "bie/app/bench_printer.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdio>

#include "bie/app/run_progress.hpp"

namespace vehd {

void BenchPrinter::section(const std::string& title) { print("\n== " + title + "\n"); }

void BenchPrinter::note(const std::string& line) { print(line + "\n"); }

void BenchPrinter::warn(const std::string& problem) {
  progress_.clear();
  spdlog::warn("{}", problem);
}

void BenchPrinter::heading(const BenchTable& table) { print(heading_line(table)); }

void BenchPrinter::row(const BenchTable& table, const std::vector<BenchCell>& row) { print(row_line(table, row)); }

void BenchPrinter::task(int number, int n_tasks, const std::string& what) {
  progress_.begin(static_cast<double>(number - 1) / n_tasks, fmt::format("[{}/{}] {}", number, n_tasks, what));
}

void BenchPrinter::status(const RunStatus& status) { show_run(progress_, status); }

void BenchPrinter::print(const std::string& text) {
  progress_.clear();
  fmt::print("{}", text);
  std::fflush(stdout);
}

}  // namespace vehd

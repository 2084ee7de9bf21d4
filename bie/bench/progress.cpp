#include "bie/bench/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace vehd {

BenchProgress::BenchProgress(int n_tasks) : n_tasks_(n_tasks), on_terminal_(isatty(STDERR_FILENO) == 1) {}

BenchProgress::~BenchProgress() { clear(); }

void BenchProgress::next(const std::string& task) {
  constexpr std::chrono::seconds kInterval{2};
  ++n_begun_;
  const std::string text = fmt::format("[{}/{}] {}", n_begun_, n_tasks_, task);
  if (on_terminal_) {
    fmt::print(stderr, "\r{}\033[K", text);
    std::fflush(stderr);
    line_open_ = true;
  } else if (Clock::now() - last_ >= kInterval) {
    fmt::print(stderr, "{}\n", text);
    last_ = Clock::now();
  }
}

void BenchProgress::clear() {
  if (!line_open_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  line_open_ = false;
}

}  // namespace vehd

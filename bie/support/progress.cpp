#include "bie/support/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vehd {
namespace {

constexpr std::chrono::milliseconds bar_interval{100};
constexpr std::chrono::seconds line_interval{5};
constexpr int widest_bar = 30;

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string bar(double fraction, int width) {
  const int filled = static_cast<int>(std::lround(fraction * width));
  std::string text;
  for (int i = 0; i < width; ++i) text += i < filled ? "█" : "░";
  return text;
}

}  // namespace

Progress::Style Progress::suitable_style() { return isatty(STDERR_FILENO) == 1 ? Style::bar : Style::lines; }

Progress::Progress(Style style, double start_time, double end_time)
    : style_(style), start_time_(start_time), end_time_(end_time) {}

Progress::~Progress() {
  if (line_open_) std::fputs("\n", stderr);
}

void Progress::update(const ProgressState& state) {
  state_ = state;
  pending_ = true;
  const Clock::duration since = Clock::now() - last_drawn_;
  if (style_ == Style::bar ? since >= bar_interval : since >= line_interval) draw();
}

void Progress::finish() {
  if (pending_) draw();
  if (line_open_) std::fputs("\n", stderr);
  line_open_ = false;
}

std::string Progress::text() const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double done = state_.time - start_time_;
  const std::string left =
      done > 0.0 ? duration_text(elapsed / done * std::max(0.0, end_time_ - state_.time)) : std::string("?");
  return fmt::format("step {}  t {:.4g}/{:.4g}  dt {:.3g}  drift {:.1e}  left {}", state_.step, state_.time, end_time_,
                     state_.dt, state_.drift, left);
}

void Progress::draw() {
  last_drawn_ = Clock::now();
  pending_ = false;
  if (style_ == Style::none) return;
  const double fraction = end_time_ > 0.0 ? std::clamp(state_.time / end_time_, 0.0, 1.0) : 1.0;
  if (style_ == Style::lines) {
    fmt::print(stderr, "{:3.0f}%  {}\n", 100.0 * fraction, text());
    return;
  }
  const std::string numbers = text();
  const int room = terminal_width() - static_cast<int>(numbers.size()) - 8;
  const int width = std::clamp(room, 0, widest_bar);
  fmt::print(stderr, "\r{} {:3.0f}%  {}\033[K", bar(fraction, width), 100.0 * fraction, numbers);
  std::fflush(stderr);
  line_open_ = true;
}

std::string duration_text(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  // Also catches what no integer holds.
  if (!(seconds < 1e7)) return "long";
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02d}", whole / 60, whole % 60);
  return fmt::format("{}:{:02d}:{:02d}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace vehd

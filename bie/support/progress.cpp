#include "bie/support/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bie/support/text_table.hpp"

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

Progress::Progress(Style style) : style_(style) {}

Progress::~Progress() {
  if (line_open_) std::fputs("\n", stderr);
}

void Progress::update(double share, const std::string& text) {
  share_ = std::clamp(share, 0.0, 1.0);
  text_ = text;
  pending_ = true;
  const Clock::duration since = Clock::now() - last_drawn_;
  if (style_ == Style::bar ? since >= bar_interval : since >= line_interval) draw();
}

void Progress::begin(double share, const std::string& text) {
  update(share, text);
  if (pending_ && style_ == Style::bar) draw();
}

void Progress::finish() {
  if (pending_) draw();
  if (line_open_) std::fputs("\n", stderr);
  line_open_ = false;
}

void Progress::clear() {
  pending_ = false;
  if (!line_open_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  line_open_ = false;
}

void Progress::draw() {
  last_drawn_ = Clock::now();
  pending_ = false;
  if (style_ == Style::none) return;
  if (style_ == Style::lines) {
    fmt::print(stderr, "{:3.0f}%  {}\n", 100.0 * share_, text_);
    return;
  }
  const int room = terminal_width() - static_cast<int>(display_width(text_)) - 8;
  const int width = std::clamp(room, 0, widest_bar);
  fmt::print(stderr, "\r{} {:3.0f}%  {}\033[K", bar(share_, width), 100.0 * share_, text_);
  std::fflush(stderr);
  line_open_ = true;
}

std::string duration_text(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  if (!std::isfinite(seconds)) return "unknown";
  if (seconds >= 1e7) return fmt::format("{:.0f} days", seconds / 86400.0);
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02d}", whole / 60, whole % 60);
  return fmt::format("{}:{:02d}:{:02d}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace vehd

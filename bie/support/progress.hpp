#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace vehd {

/// What the progress line shows.
struct ProgressState {
  std::int64_t step = 0;
  double time = 0.0;
  double dt = 0.0;
  double drift = 0.0;  ///< larger of area and volume drift
};

/// Progress on standard error: a bar redrawn in place on a terminal, otherwise a plain line now and then.
class Progress {
 public:
  enum class Style { bar, lines, none };
  /// Bar on a terminal, lines elsewhere.
  static Style suitable_style();

  Progress(Style style, double start_time, double end_time);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(const ProgressState& state);
  /// Draws the last state whatever the interval, and leaves the line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void draw();
  [[nodiscard]] std::string text() const;

  Style style_;
  double start_time_, end_time_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_drawn_{};
  ProgressState state_;
  bool pending_ = false;
  bool line_open_ = false;
};

/// "1:02:03", "2:05" or "4.2 s".
std::string duration_text(double seconds);

}  // namespace vehd

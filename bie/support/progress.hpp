#pragma once

#include <chrono>
#include <string>

namespace vehd {

/// Progress of some work on standard error: a bar redrawn in place on a terminal, otherwise a line every 5 s.
class Progress {
 public:
  /// Form of the display.
  enum class Style { bar, lines, none };
  /// Bar on a terminal, lines elsewhere.
  static Style suitable_style();

  explicit Progress(Style style);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param share  fraction of the work that is done, 0 ... 1
  /// @param text   shown beside it, one line
  void update(double share, const std::string& text);
  /// Update at the beginning of a part of the work that may take long: a bar shows it at once.
  void begin(double share, const std::string& text);
  /// Draws the last state at once and ends the line.
  void finish();
  /// Erases the bar, so that results can be printed in its place.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void draw();

  Style style_;
  Clock::time_point last_drawn_{};
  double share_ = 0.0;
  std::string text_;
  bool pending_ = false;
  bool line_open_ = false;
};

/// "4.2 s", "12 s", "2:05", "1:02:03" or "120 days"; "unknown" if not finite.
std::string duration_text(double seconds);

}  // namespace vehd

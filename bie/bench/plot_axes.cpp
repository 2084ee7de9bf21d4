#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/bench/picture.hpp"

namespace vehd {
namespace {

constexpr double marker_radius = 3.5;

struct Bounds {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  void take(double value) {
    if (!std::isfinite(value)) return;
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
};

/// Boxes that a note must not overlap: points of the curves, and the lines between them.
std::vector<Box> taken_by(const BenchPanel& panel, const PlotAxes& axes) {
  std::vector<Box> taken;
  const auto add = [&taken](double x, double y, double radius) {
    taken.push_back({x - radius, y - radius, x + radius, y + radius});
  };
  const auto add_line = [&](double x0, double y0, double x1, double y1) {
    constexpr double step = 2.0;
    const int n = std::max(1, static_cast<int>(std::hypot(x1 - x0, y1 - y0) / step));
    for (int k = 0; k <= n; ++k) add(x0 + (x1 - x0) * k / n, y0 + (y1 - y0) * k / n, 0.5);
  };
  for (const BenchCurve& curve : panel.curves) {
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const double x = axes.x.place(curve.x[i]), y = axes.y.place(curve.y[i]);
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      add(x, y, marker_radius);
      if (i == 0) continue;
      const double x0 = axes.x.place(curve.x[i - 1]), y0 = axes.y.place(curve.y[i - 1]);
      if (std::isfinite(x0) && std::isfinite(y0)) add_line(x0, y0, x, y);
    }
  }
  for (const BenchSlope& slope : panel.slopes) {
    const double y_to = slope.y_from * std::pow(slope.x_to / slope.x_from, slope.exponent);
    add_line(axes.x.place(slope.x_from), axes.y.place(slope.y_from), axes.x.place(slope.x_to), axes.y.place(y_to));
  }
  return taken;
}

/// Midpoints of a box of this size around a point: the nearest first, among those the one on the upper right first.
std::vector<PagePoint> places_around(double x, double y, double width, double height) {
  constexpr std::array distances{4.0, 6.0, 9.0, 12.0};
  constexpr int n_directions = 16;
  std::vector<PagePoint> places;
  for (const double distance : distances) {
    for (int i = 0; i < n_directions; ++i) {
      // 3, 2, 4, 1, 5 … sixteenths of a turn.
      const int turn = 3 + (i % 2 == 0 ? i / 2 : -(i + 1) / 2);
      const double angle = 2.0 * std::numbers::pi * turn / n_directions;
      places.push_back(
          {x + (0.5 * width + distance) * std::cos(angle), y + (0.5 * height + distance) * std::sin(angle)});
    }
  }
  return places;
}

class NotePlaces {
 public:
  NotePlaces(const PlotAxes& axes, std::vector<Box> taken, double font)
      : inside_{0.0, 0.0, axes.x.length, axes.y.length}, taken_(std::move(taken)), font_(font) {}

  void place(const std::string& text, double x, double y, int colour) {
    if (text.empty() || !std::isfinite(x) || !std::isfinite(y)) return;
    const double width = font_ * text_width(text), height = 1.25 * font_;
    for (const PagePoint& middle : places_around(x, y, width, height)) {
      const Box box{middle[0] - 0.5 * width, middle[1] - 0.5 * height, middle[0] + 0.5 * width,
                    middle[1] + 0.5 * height};
      if (!inside_.holds(box) || std::ranges::any_of(taken_, [&](const Box& other) { return box.meets(other); }))
        continue;
      taken_.push_back(box);
      notes.push_back({text, middle, colour});
      return;
    }
  }

  std::vector<PlacedNote> notes;

 private:
  Box inside_;
  std::vector<Box> taken_;
  double font_;
};

}  // namespace

double PlotScale::place(double value) const {
  if (logarithmic) {
    if (!(value > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    return length * std::log(value / lower) / std::log(upper / lower);
  }
  return length * (value - lower) / (upper - lower);
}

PlotAxes axes_of(const BenchPanel& panel, double width, double height) {
  Bounds x, y;
  for (const BenchCurve& curve : panel.curves) {
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!(curve.y[i] > 0.0)) continue;
      x.take(curve.x[i]);
      y.take(curve.y[i]);
    }
  }
  for (const BenchSlope& slope : panel.slopes) {
    y.take(slope.y_from);
    y.take(slope.y_from * std::pow(slope.x_to / slope.x_from, slope.exponent));
  }
  for (const double tick : panel.x_ticks) x.take(tick);
  if (!(x.lower <= x.upper)) x = {1.0, 10.0};
  if (!(y.lower <= y.upper)) y = {1.0, 10.0};
  PlotAxes axes;
  axes.x.length = width;
  axes.y.length = height;
  axes.x.logarithmic = !panel.straight_x;
  if (panel.straight_x) {
    const double room = 0.06 * std::max(x.upper - x.lower, 1.0);
    axes.x.lower = x.lower - room;
    axes.x.upper = x.upper + room;
  } else {
    const double room = std::max(1.15, std::pow(x.upper / x.lower, 0.08));
    axes.x.lower = x.lower / room;
    axes.x.upper = x.upper * room;
  }
  // Keeps points off the frame.
  constexpr double room = 1.4;
  axes.y.lower = std::pow(10.0, std::floor(std::log10(y.lower / room)));
  axes.y.upper = std::pow(10.0, std::ceil(std::log10(y.upper * room)));
  return axes;
}

std::vector<PlacedNote> place_notes(const BenchPanel& panel, const PlotAxes& axes, double font) {
  NotePlaces places(axes, taken_by(panel, axes), font);
  for (const BenchSlope& slope : panel.slopes) {
    // At the end, otherwise at the beginning: a line without its label has no meaning.
    const double y_to = slope.y_from * std::pow(slope.x_to / slope.x_from, slope.exponent);
    const std::size_t before = places.notes.size();
    places.place(slope.label, axes.x.place(slope.x_to), axes.y.place(y_to), -1);
    if (places.notes.size() == before) {
      places.place(slope.label, axes.x.place(slope.x_from), axes.y.place(slope.y_from), -1);
    }
  }
  for (const BenchCurve& curve : panel.curves) {
    for (std::size_t i = 0; i < std::min(curve.notes.size(), curve.x.size()); ++i) {
      places.place(curve.notes[i], axes.x.place(curve.x[i]), axes.y.place(curve.y[i]), curve.colour);
    }
  }
  return std::move(places.notes);
}

}  // namespace vehd

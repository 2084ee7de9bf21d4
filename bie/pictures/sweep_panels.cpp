#include "bie/pictures/sweep_panels.hpp"

#include <cmath>
#include <numbers>

namespace vehd {

namespace {

constexpr double sweep_panel_width = 255.0, sweep_panel_height = 172.0;

}  // namespace

SweepPanels::SweepPanels(std::size_t count) : across_(count > 1 ? 2 : 1) {
  const std::size_t down = (count + across_ - 1) / across_;
  page.width = sweep_panel_width * static_cast<double>(across_);
  page.height = sweep_panel_height * static_cast<double>(down);
}

Box SweepPanels::box(std::size_t panel) const {
  const double left = sweep_panel_width * static_cast<double>(panel % across_);
  const double top = page.height - sweep_panel_height * static_cast<double>(panel / across_);
  return {left + 46.0, top - sweep_panel_height + 34.0, left + sweep_panel_width - 16.0, top - 24.0};
}

PageArea sweep_dot(const PagePoint& at, const char* colour) {
  constexpr double radius = 1.7;
  PageArea area{{}, colour};
  for (int i = 0; i < 8; ++i) {
    const double angle = std::numbers::pi / 4.0 * (i + 0.5);
    area.points.push_back({at[0] + radius * std::cos(angle), at[1] + radius * std::sin(angle)});
  }
  return area;
}

}  // namespace vehd

#pragma once

#include <string>

#include "bie/pictures/page.hpp"

namespace vehd {

/// A page of line plots of one size, two beside each other.
struct SweepPanels {
  Page page;

  explicit SweepPanels(std::size_t count);
  /// The frame of one of them.
  [[nodiscard]] Box box(std::size_t panel) const;

 private:
  std::size_t across_;
};

/// A point of a plot as an octagon.
PageArea sweep_dot(const PagePoint& at, const char* colour);

}  // namespace vehd

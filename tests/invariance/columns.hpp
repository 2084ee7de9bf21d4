#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/invariance/scaled_scene.hpp"
#include "tests/invariance/short_run.hpp"

namespace vehd::testing {

/// A column of history.csv.
struct Column {
  std::string name;
  double VesicleDiagnostics::*member;
  std::array<int, 4> powers{};  ///< powers of length, time, viscosity and potential
  /// Whether the value depends on neither position nor orientation, on orientation, or is a position or drift itself.
  enum class Depends { on_nothing, on_axes, on_place } depends = Depends::on_nothing;
  double least_scale = 0.0;  ///< of differences, dimensionless; smaller ones are rounding or solver error
  /// Value of a column that is no member, and the scale of its differences besides its own size; each may be null.
  double (*derived)(const VesicleDiagnostics&) = nullptr;
  double (*scale)(const VesicleDiagnostics&) = nullptr;

  [[nodiscard]] double value(const VesicleDiagnostics& d) const { return derived != nullptr ? derived(d) : d.*member; }

  [[nodiscard]] double factor(const UnitFactors& units) const {
    return units.of(powers[0], powers[1], powers[2], powers[3]);
  }
};

const std::vector<Column>& columns();

struct Deviation {
  double size = 0.0;
  std::string column;
};

/// Largest difference in any row between two histories of the same physics, over the largest value of the column.
/// @param columns_up_to  columns that depend on more are left out
Deviation largest_deviation(const ShortRun& base, const ShortRun& other, const UnitFactors& units,
                            Column::Depends columns_up_to = Column::Depends::on_place);

}  // namespace vehd::testing

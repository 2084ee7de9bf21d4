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
  std::array<int, 4> powers{};  ///< of length, time, viscosity and potential
  bool is_scalar = true;        ///< the same in every place and orientation
  double least_scale = 0.0;     ///< of differences, dimensionless: what is this small is rounding or solver error

  [[nodiscard]] double factor(const UnitFactors& units) const {
    return units.of(powers[0], powers[1], powers[2], powers[3]);
  }
};

const std::vector<Column>& columns();

struct Deviation {
  double size = 0.0;
  std::string column;
};

/// The largest difference of two histories of the same physics in any row, over the largest value of the column.
/// @param scalars_only  where place and orientation differ
Deviation largest_deviation(const ShortRun& base, const ShortRun& other, const UnitFactors& units,
                            bool scalars_only = false);

}  // namespace vehd::testing

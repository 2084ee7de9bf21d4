#pragma once

namespace vehd {

/// What a tolerance makes the default of [numerics].
struct AccuracyDefaults {
  int order;       ///< highest degree
  int time_order;  ///< order of a step
};

AccuracyDefaults accuracy_defaults(double tolerance);

}  // namespace vehd

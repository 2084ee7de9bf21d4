#pragma once

#include <limits>

#include "bie/support/types.hpp"

namespace vehd {

/// When and where a membrane has first met the criterion of poration.
struct FirstCrossing {
  double time = std::numeric_limits<double>::infinity();                        ///< infinite until then
  Vector3 place = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< in the coordinates of the state
};

}  // namespace vehd

#pragma once

#include <optional>
#include <string>

#include "bie/support/types.hpp"

namespace vehd {

/// The model's values for all data, those of one experiment after those of the other; absent where a run did not reach
/// its end.
struct Prediction {
  std::optional<Vector> values;
  std::string problem{};  ///< why they are absent
};

}  // namespace vehd

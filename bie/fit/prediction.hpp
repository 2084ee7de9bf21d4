#pragma once

#include <optional>
#include <string>

#include "bie/support/types.hpp"

namespace vehd {

/// The model's values for all data, experiment after experiment, [n_data]; absent if a run did not reach its end.
struct Prediction {
  std::optional<Vector> values;
  std::string problem{};  ///< why they are absent
};

}  // namespace vehd

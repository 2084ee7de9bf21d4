#pragma once

#include <optional>
#include <string>

#include "bie/support/types.hpp"

namespace vehd {

/// Model values for all data, in the order of the experiments, [n_data]; absent if a run did not reach its end.
struct Prediction {
  std::optional<Vector> values;
  std::string problem{};  ///< why they are absent
};

}  // namespace vehd

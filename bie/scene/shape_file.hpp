#pragma once

#include <optional>
#include <string>

#include "bie/support/types.hpp"

namespace vehd {

/// Position coefficients of one snapshot of a run.h5, [n_coefficients x 3], in the order of that run.
/// @param time  absent: the last snapshot
/// @throws InputError if the file is damaged, no run.h5, or has no snapshot at that time
Matrix read_shape_file(const std::string& path, std::optional<double> time);

}  // namespace vehd

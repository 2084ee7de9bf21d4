#pragma once

#include <functional>
#include <string>

namespace vehd::fem_check {

/// Takes one line on what has been done.
using Report = std::function<void(const std::string& line)>;

}  // namespace vehd::fem_check

#pragma once

#include <functional>
#include <string>

namespace vehd::fem_check {

/// Receives one line about each completed step.
using Report = std::function<void(const std::string& line)>;

}  // namespace vehd::fem_check

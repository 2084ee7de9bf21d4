#pragma once

#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

/// Input of benches of single steps. Both throw InputError.
namespace vehd {

/// The scene with fixed steps: without its tolerance.
/// @param bench  its name on the command line
Scene with_fixed_steps(Scene scene, const std::string& bench);

/// @param option  as on the command line
void require_ascending(const std::string& option, const std::vector<int>& values);

}  // namespace vehd

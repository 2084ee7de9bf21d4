#pragma once

#include <string>

#include "bie/scene/scene.hpp"

namespace vehd {

/// The scene as TOML with every default spelled out; reading it back gives an equal scene.
std::string effective_scene(const Scene& scene);

}  // namespace vehd

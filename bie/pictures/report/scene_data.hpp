#pragma once

#include <nlohmann/json.hpp>

#include "bie/scene/scene.hpp"

namespace vehd {

/// The effective scene for a page: its "text" and the "tables" of its keys with their meaning.
nlohmann::json scene_data(const Scene& scene);

/// The dimensionless groups of the scene; none where its shape file is gone.
nlohmann::json groups_data(const Scene& scene);

/// Arrows of the field and of a linear flow around the axes, which have length 1.
nlohmann::json arrows_data(const Scene& scene);

/// The scene in one line: shape, effects, degree.
std::string headline_of(const Scene& scene);

}  // namespace vehd

#pragma once

#include <toml++/toml.h>

#include <string>

#include "bie/scene/scene.hpp"

/// Conditions that tie several values of a scene together; single values are checked against the key table.
namespace vehd {

/// Of a scene of one vesicle.
/// @param is_heavy  another vesicle beside it has a weight
/// @throws InputError "file:line: ..." at the key to blame
void check_scene(const Scene& scene, const toml::table& table, const std::string& file, bool is_heavy = false);

/// The shape, whose area and volume must be positive and finite. @param scene  of one vesicle @throws InputError
void check_shape_size(const Scene& scene, const toml::table& table, const std::string& file);

/// The symmetry that the scene insists on; builds its shape. @throws InputError
void check_symmetry(const Scene& scene, const toml::table& table, const std::string& file);

}  // namespace vehd

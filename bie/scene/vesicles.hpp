#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bie/scene/schema.hpp"

/// Scenes of several vesicles as scenes of one each.
namespace vehd {

/// Most vesicles of a scene: every pair is computed directly, so that work and memory grow with their square.
constexpr std::size_t most_vesicles = 500;

/// Number of vesicles of a scene.
std::size_t n_vesicles(const Scene& scene);

/// The scene of one of its vesicles, as if there were no other.
Scene alone(const Scene& scene, std::size_t vesicle);
/// The scenes of all vesicles, each alone; for a single vesicle the scene itself.
std::vector<Scene> each_alone(const Scene& scene);

/// One scene of several vesicles, the inverse of each_alone.
/// @param vesicles  scenes of one each, which differ only in keys that vesicles may have
/// @param names     one for each; a single vesicle has none
Scene together(const std::vector<Scene>& vesicles, const std::vector<std::string>& names);

/// Names of the vesicles; empty if there is only one.
std::vector<std::string> vesicle_names(const Scene& scene);

/// Check for commands that accept only one vesicle.
/// @param file  of the scene, for the message
/// @param who   "vehd mesh" @throws InputError if there are several
void require_one_vesicle(const Scene& scene, const std::filesystem::path& file, const std::string& who);

/// May every vesicle have a value of its own for this key?
bool is_of_vesicle(std::string_view table, std::string_view key);
/// is_of_vesicle of a key of the key table.
bool is_of_vesicle(const KeyDescription& key);
/// The tables that have such keys, in the order of scene_tables().
const std::vector<std::string_view>& vesicle_tables();

}  // namespace vehd

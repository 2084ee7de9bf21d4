#include "tests/invariance/scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bie/bench/stability_case.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/file_system.hpp"

namespace vehd::testing {

std::vector<NamedScene> all_scenes() {
  const std::filesystem::path source(VEHD_SOURCE_DIR);
  std::vector<NamedScene> result;
  for (const auto& path : files_ending(source / "docs/scenes", ".toml")) {
    Scene scene = read_scene(path);
    // Scenes of several vesicles take minutes without symmetry: two_vesicles stands for them.
    if (scene.vesicles.empty()) result.push_back({path.stem().string(), std::move(scene)});
  }
  result.push_back({"two_vesicles", read_scene(source / "tests/invariance/two_vesicles.toml")});
  result.push_back({"exchanged_vesicles", read_scene(source / "tests/invariance/exchanged_vesicles.toml")});
  result.push_back({"two_vesicles_relaxing", read_scene(source / "tests/invariance/two_vesicles_relaxing.toml")});
  result.push_back({"two_vesicles_pores", read_scene(source / "tests/invariance/two_vesicles_pores.toml")});
  result.push_back({"contact", read_scene(source / "tests/invariance/contact.toml")});
  result.push_back({"averaged", read_scene(source / "tests/invariance/averaged.toml")});
  for (const char* name : {"poration_criterion", "porosity", "pores", "varying_membrane"}) {
    result.push_back({name, read_scene(source / "tests/invariance" / (std::string(name) + ".toml"))});
  }
  for (const auto& path : files_ending(source / "tests/hard/scenes", ".toml")) {
    StabilityCase hard = read_stability_case(path);
    hard.scene.numerics.end_time = std::min(hard.scene.numerics.end_time, hard.short_end_time);
    result.push_back({hard.name, hard.scene});
  }
  for (const char* name : {"two_spheres", "sphere_beside_prolate"}) {
    Scene scene = read_scene(source / "tests/invariance" / (std::string(name) + ".toml"));
    for (const int time_order : {1, 4}) {
      scene.numerics.time_order = time_order;
      result.push_back({name + fmt::format("_order_{}", time_order), scene});
    }
    scene = at_tolerance(scene, 1e-3);
    scene.numerics.order = 10;
    result.push_back({name + std::string("_tolerance"), std::move(scene)});
  }
  for (const char* name : {"everything", "above_wall", "poiseuille", "sphere", "sphere_in_tube"}) {
    Scene scene = read_scene(source / "tests/invariance" / (std::string(name) + ".toml"));
    for (int time_order = 1; time_order <= highest_time_order; ++time_order) {
      scene.numerics.time_order = time_order;
      result.push_back({name + fmt::format("_order_{}", time_order), scene});
    }
    scene.numerics.order = 16;
    result.push_back({name + std::string("_tolerance"), at_tolerance(scene, 1e-3)});
  }
  return result;
}

std::mt19937_64 random_of(const NamedScene& of, const std::string& purpose) {
  const std::string text = purpose + " of " + of.name;
  std::seed_seq seeds(text.begin(), text.end());
  return std::mt19937_64(seeds);
}

}  // namespace vehd::testing

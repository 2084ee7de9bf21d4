#include "bie/scene/vesicles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bie/support/errors.hpp"

namespace vehd {

std::size_t n_vesicles(const Scene& scene) { return std::max<std::size_t>(scene.vesicles.size(), 1); }

Scene alone(const Scene& scene, std::size_t vesicle) {
  Scene result = scene;
  result.vesicles.clear();
  if (scene.vesicles.empty()) return result;
  const VesicleScene& own = scene.vesicles.at(vesicle);
  result.shape = own.shape;
  result.membrane = own.membrane;
  result.fluid = own.fluid;
  result.electric = own.electric;
  return result;
}

std::vector<Scene> each_alone(const Scene& scene) {
  std::vector<Scene> result;
  for (std::size_t a = 0; a < n_vesicles(scene); ++a) result.push_back(alone(scene, a));
  return result;
}

Scene together(const std::vector<Scene>& vesicles, const std::vector<std::string>& names) {
  Scene result = vesicles.front();
  if (vesicles.size() < 2) return result;
  for (std::size_t a = 0; a < vesicles.size(); ++a) {
    const Scene& one = vesicles[a];
    result.vesicles.push_back({names[a], one.shape, one.membrane, one.fluid, one.electric});
  }
  return result;
}

std::vector<std::string> vesicle_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const VesicleScene& vesicle : scene.vesicles) names.push_back(vesicle.name);
  return names;
}

void require_one_vesicle(const Scene& scene, const std::filesystem::path& file, const std::string& who) {
  if (scene.vesicles.empty()) return;
  throw InputError(
      fmt::format("{}: has {} vesicles; {} accepts a scene of one", file.string(), scene.vesicles.size(), who));
}

bool is_of_vesicle(std::string_view table, std::string_view key) {
  if (table == "shape") return true;
  if (table == "membrane") return key != "mobile";
  if (table.starts_with("membrane.")) return true;
  if (table == "fluid") return key == "viscosity_ratio" || key == "density_difference";
  return table == "electric" && (key == "conductivity_in" || key == "permittivity_ratio" || key == "initial_Vm");
}

bool is_of_vesicle(const KeyDescription& key) { return is_of_vesicle(key.table, key.name); }

const std::vector<std::string_view>& vesicle_tables() {
  static const std::vector<std::string_view> tables{"shape", "membrane", "fluid", "electric"};
  return tables;
}

}  // namespace vehd

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vehd {

/// A scene that comes with the program: the text of docs/scenes/NAME.toml.
struct ShippedScene {
  std::string_view name;
  std::string_view text;
};

/// All scenes of docs/scenes at the time of the build, ordered by name.
const std::vector<ShippedScene>& shipped_scenes();

/// Description of a scene: the first sentence of its first comment.
std::string title_of(const ShippedScene& scene);

}  // namespace vehd

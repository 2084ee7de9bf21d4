#pragma once

#include <random>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd::testing {

struct NamedScene {
  std::string name;
  Scene scene;
};

/// Every shipped scene; every hard case in its short form; everything at once, and a pulse off the axis of a tube, on a
/// vesicle that deforms and on a sphere, at every order in time and with a tolerance; spheres among several.
std::vector<NamedScene> all_scenes();

/// Random numbers of a scene's own, whatever other scenes there are.
std::mt19937_64 random_of(const NamedScene& of, const std::string& purpose);

}  // namespace vehd::testing

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

/// All shipped scenes; all hard cases in short form; all effects at once, and a pulse off the axis of a tube, on a
/// deforming vesicle and on a sphere, at every order in time and with a tolerance; spheres among several vesicles.
std::vector<NamedScene> all_scenes();

/// Random numbers of this scene, independent of the other scenes.
std::mt19937_64 random_of(const NamedScene& of, const std::string& purpose);

}  // namespace vehd::testing

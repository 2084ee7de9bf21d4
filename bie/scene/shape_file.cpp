#include "bie/scene/shape_file.hpp"

#include "bie/scene/reader.hpp"
#include "bie/scene/units.hpp"

namespace vehd {

ShapeFile::ShapeFile(const Scene& scene) : run_(scene.shape.path) {
  const auto units = units_of(run_);
  const auto factor = [&](std::optional<double> UnitsScene::*scale) {
    return conversion(units, scene.units, scale).value_or(1.0);
  };
  length_ = factor(&UnitsScene::length);
  potential_ = factor(&UnitsScene::potential);
  const auto& time = scene.shape.time;
  number_ = time ? run_.at(*time / factor(&UnitsScene::time)) : run_.times().size() - 1;
}

Matrix ShapeFile::position() const { return length_ * snapshot().coefficients("x", 3); }

Vector ShapeFile::potential() const { return potential_ * snapshot().coefficients("Vm", 1).col(0); }

std::optional<UnitsScene> units_of(const RunReader& run) {
  if (!run.has_scene()) return std::nullopt;
  return parse_units(run.scene(), run.name() + " (scene)");
}

bool takes_stored_potential(const Scene& scene) {
  return scene.electric && scene.electric->initial_potential == InitialPotential::file;
}

}  // namespace vehd

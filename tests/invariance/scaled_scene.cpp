#include "tests/invariance/scaled_scene.hpp"

#include <cmath>
#include <utility>
#include <variant>

#include "bie/scene/schema.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd::testing {
namespace {

struct Multiply {
  double factor;

  template <typename Other>
  void operator()(Other&) const {}
  void operator()(double& value) const { value *= factor; }
  void operator()(Triple& values) const {
    for (double& value : values) value *= factor;
  }
  void operator()(TripleOfTriples& rows) const {
    for (Triple& row : rows) (*this)(row);
  }
  void operator()(std::vector<double>& values) const {
    for (double& value : values) value *= factor;
  }
  void operator()(std::vector<OutputWindow>& windows) const {
    for (OutputWindow& window : windows) {
      for (double* value : {&window.from, &window.to, &window.every}) *value *= factor;
    }
  }
};

/// In a radius base + s, s is a length; in base + amplitude exp(exponent s) it is not.
bool has_modes_of_length(const ShapeScene& shape) { return shape.kind == ShapeKind::radial && !shape.amplitude; }

}  // namespace

double UnitFactors::of(int lengths, int times, int viscosities, int potentials) const {
  return std::pow(length, lengths) * std::pow(time, times) * std::pow(viscosity, viscosities) *
         std::pow(potential, potentials);
}

Scene in_units(Scene scene, const UnitFactors& factors) {
  if (!scene.vesicles.empty()) {
    std::vector<Scene> each = each_alone(scene);
    for (Scene& one : each) one = in_units(std::move(one), factors);
    return together(each, vesicle_names(scene));
  }
  for (const KeyDescription& key : scene_keys()) {
    const Dimension* dimension = find_dimension(key.unit);
    if (dimension == nullptr || key.type == ValueType::quantity || !applies(key, scene)) continue;
    std::optional<Value> value = key.get(scene);
    if (!value) continue;
    const auto& powers = dimension->powers;
    std::visit(Multiply{factors.of(powers[0], powers[1], powers[2], powers[3])}, *value);
    key.set(scene, *value);
  }
  if (has_unit_size(scene.shape.kind) && !scene.shape.area)
    scene.shape.scale = factors.length * scene.shape.scale.value_or(1.0);
  if (has_modes_of_length(scene.shape)) {
    for (HarmonicMode& mode : scene.shape.modes) mode.a *= factors.length;
  }
  return scene;
}

}  // namespace vehd::testing

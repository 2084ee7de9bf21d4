#include "bie/scene/model_of.hpp"

#include "bie/scene/initial_shape.hpp"

namespace vehd {
namespace {

BackgroundFlow background_flow_of(const FlowScene& flow) {
  switch (flow.kind) {
    case FlowKind::shear:
      return shear_flow(flow.rate);
    case FlowKind::planar_extension:
      return planar_extension(flow.rate);
    case FlowKind::axisymmetric_extension:
      return axisymmetric_extension(flow.rate);
    case FlowKind::gradient:
      break;
  }
  BackgroundFlow result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.gradient(i, j) = flow.gradient[i][j];
  }
  return result;
}

}  // namespace

Model model_of(const Scene& scene) {
  Model model;
  model.viscosity = scene.fluid.viscosity;
  model.inextensible = scene.membrane.inextensible;
  if (scene.membrane.bending_modulus.value_or(0.0) > 0.0) {
    model.bending = BendingParameters{*scene.membrane.bending_modulus};
  }
  if (scene.flow) model.flow = background_flow_of(*scene.flow);
  if (scene.electric) {
    ElectricParameters electric;
    electric.field = Vector3(scene.electric->field[0], scene.electric->field[1], scene.electric->field[2]);
    electric.conductivity_in = scene.electric->conductivity_in;
    electric.conductivity_out = scene.electric->conductivity_out;
    electric.permittivity = scene.electric->permittivity;
    model.electric = electric;
    model.charging = ChargingParameters{scene.membrane.capacitance, scene.membrane.conductance};
  }
  return model;
}

NumericalSettings settings_of(const Scene& scene) {
  NumericalSettings settings;
  settings.order = scene.numerics.order;
  return settings;
}

Symmetry symmetry_of(const Scene& scene, const Model& model) {
  if (scene.numerics.symmetry == SymmetryUse::off) return {};
  State start;
  start.position = initial_position(scene);
  start.area_strain = Vector::Zero(start.position.rows());
  return find_symmetry(model, start);
}

Discretisation discretisation_of(const Scene& scene, const Model& model) {
  return Discretisation(settings_of(scene), symmetry_of(scene, model));
}

}  // namespace vehd

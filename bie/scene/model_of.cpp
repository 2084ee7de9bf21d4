#include "bie/scene/model_of.hpp"

#include <algorithm>
#include <limits>

#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/poiseuille_flow.hpp"
#include "bie/physics/effects/poration.hpp"
#include "bie/physics/effects/spontaneous_curvature.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/scene/waveforms.hpp"

namespace vehd {
namespace {

/// Waveform of a table; 1 at all times if the table is absent or has no effect.
Waveform waveform_in(const Scene& scene, std::string_view table) {
  const std::vector<ActingWaveform> acting = acting_waveforms(scene);
  const auto found = std::ranges::find(acting, table, &ActingWaveform::table);
  return found == acting.end() ? Waveform() : waveform_of(found->waveform);
}

BackgroundFlow linear_flow(const FlowScene& flow) {
  if (flow.kind == FlowKind::shear) return shear_flow(flow.rate);
  if (flow.kind == FlowKind::planar_extension) return planar_extension(flow.rate);
  if (flow.kind == FlowKind::axisymmetric_extension) return axisymmetric_extension(flow.rate);
  BackgroundFlow result;
  for (int i = 0; i < 3; ++i) result.gradient.row(i) = vector_of(flow.gradient[i]).transpose();
  return result;
}

/// @param scene  of one vesicle, with [poration]
void add_poration(const Scene& scene, VesicleModel& vesicle) {
  const PorationScene& p = *scene.poration;
  if (p.model == PorationModel::criterion) {
    vesicle.criterion = PorationCriterion{p.threshold_potential, p.lysis_tension};
  } else if (p.model == PorationModel::porosity) {
    vesicle.reaction = std::make_shared<MembranePorosity>(PorosityParameters{
        p.porated_conductance, *p.threshold_potential, p.steepness, p.poration_time, p.resealing_time});
  } else {
    const double conductivity = p.pore_conductivity.value_or(
        pore_conductivity(scene.electric->conductivity_in, scene.electric->conductivity_out));
    vesicle.reaction = std::make_shared<PoreDensity>(
        PoreParameters{p.creation_rate, *p.threshold_potential, p.rest_density, p.exponent,
                       pore_conductance(p.pore_radius, p.membrane_thickness, conductivity)});
  }
}

/// @param scene  of this vesicle only
VesicleModel vesicle_of(const Scene& scene) {
  const MembraneScene& m = scene.membrane;
  VesicleModel vesicle;
  vesicle.viscosity_ratio = scene.fluid.viscosity_ratio;
  vesicle.inextensible = m.inextensible;
  vesicle.has_varying_properties = has_varying_properties(m);
  if (const double modulus = m.bending_modulus.value_or(0.0); modulus > 0.0) {
    vesicle.bending = BendingParameters{modulus};
    if (m.undulations) {
      vesicle.undulations = Undulations{m.temperature.value_or(0.0), 0.5 * modulus, m.stretching_modulus,
                                        m.rest_area.value_or(0.0), m.reference_tension.value_or(0.0)};
    }
    if (m.spontaneous_curvature != 0.0 && !m.varying_bending && !m.varying_curvature) {
      vesicle.effects.push_back(std::make_shared<SpontaneousCurvatureEffect>(
          SpontaneousCurvatureParameters{modulus, m.spontaneous_curvature}));
    }
  }
  if (scene.gravity && scene.fluid.density_difference != 0.0) {
    vesicle.effects.push_back(std::make_shared<GravityEffect>(
        GravityParameters{scene.fluid.density_difference, vector_of(scene.gravity->acceleration)}));
  }
  if (scene.electric) {
    vesicle.inside = {scene.electric->conductivity_in, scene.electric->permittivity_ratio};
    vesicle.charging = {m.capacitance, m.conductance};
    if (m.pump) vesicle.pump = waveform_in(scene, "membrane.pump.waveform");
  }
  if (scene.poration) add_poration(scene, vesicle);
  return vesicle;
}

/// An eighth of the shortest period of all alternating waveforms.
double longest_step_in_a_period(const Scene& scene) {
  double result = std::numeric_limits<double>::infinity();
  for (const Scene& one : each_alone(scene)) {
    for (const ActingWaveform& acting : acting_waveforms(one)) {
      if (!alternates(acting.waveform)) continue;
      result = std::min(result, 1.0 / (fewest_steps_a_period * acting.waveform.frequency));
    }
  }
  return result;
}

}  // namespace

Model model_of(const Scene& scene) {
  Model model;
  model.viscosity = scene.fluid.viscosity;
  model.mobile = scene.membrane.mobile;
  model.vesicles.clear();
  for (const Scene& one : each_alone(scene)) model.vesicles.push_back(vesicle_of(one));
  if (const auto& flow = scene.flow) {
    const Waveform waveform = waveform_in(scene, "flow.waveform");
    if (flow->kind == FlowKind::poiseuille) {
      PoiseuilleParameters parameters{flow->centre_velocity, flow->radius, waveform};
      if (flow->section == FlowSection::slit) parameters.across = Vector3::UnitZ();
      model.effects.push_back(std::make_shared<PoiseuilleFlowEffect>(std::move(parameters)));
    } else {
      model.flow = linear_flow(*flow);
      model.flow->waveform = waveform;
    }
  }
  if (scene.contact) model.contact = ContactParameters{scene.contact->energy, scene.contact->range};
  if (scene.wall) {
    model.wall = Wall{vector_of(scene.wall->point), vector_of(scene.wall->normal).stableNormalized(), scene.wall->flow,
                      scene.wall->field};
  }
  if (const auto& electric = scene.electric) {
    // With a zero field the electric part of a step is inactive until there is a V_m.
    const bool is_zero = electric->field == Triple{};
    const Waveform waveform = is_zero ? Waveform::alternating(0.0, 1.0, 0.0) : waveform_in(scene, "electric.waveform");
    model.electric = AppliedField{vector_of(electric->field), electric->conductivity_out, electric->permittivity,
                                  waveform, electric->displacement_current};
    model.electric->direction = vector_of(electric->direction);
    if (has_averaged_field(scene)) model.electric->averaged_frequency = electric->waveform->frequency;
  }
  return model;
}

StepControl step_control_of(const Scene& scene) {
  const NumericsScene& numerics = scene.numerics;
  if (!numerics.tolerance) return fixed_steps(*numerics.dt);
  // Smaller steps would be lost in the rounding of the end time. A membrane that charges within nanoseconds may be
  // simulated for hours.
  constexpr double kSmallestFraction = 1e-15;
  const double longest = std::max(numerics.end_time, std::numeric_limits<double>::min());
  return {std::min({numerics.dt.value_or(longest), longest, longest_step_in_a_period(scene)}),
          kSmallestFraction * longest, *numerics.tolerance};
}

NumericalSettings settings_of(const Scene& scene) {
  NumericalSettings settings;
  settings.order = scene.numerics.order;
  settings.time_order = scene.numerics.time_order;
  if (const std::optional<double> tolerance = scene.numerics.tolerance) {
    // Solver errors stay well below the tolerance; tighter solves would only cost time.
    settings.flow_tolerance = std::clamp(1e-3 * *tolerance, 1e-11, 1e-6);
    settings.electric_tolerance = std::clamp(1e-3 * *tolerance, 1e-12, 1e-7);
    settings.quadrature_tolerance = 0.1 * *tolerance;
  }
  return settings;
}

}  // namespace vehd

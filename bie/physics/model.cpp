#include "bie/physics/model.hpp"

namespace vehd {

FlowParameters flow_parameters(const Model& model, const VesicleModel& vesicle) {
  return {model.viscosity, vesicle.viscosity_ratio, vesicle.inextensible, vesicle.bending, vesicle.undulations};
}

bool is_averaged(const Model& model) { return model.electric && model.electric->averaged_frequency; }

bool relaxes_charge(const Model& model) {
  return model.electric && model.electric->displacement_current && !is_averaged(model);
}

ElectricParameters electric_parameters(const Model& model, const VesicleModel& vesicle) {
  const AppliedField& applied = *model.electric;
  return {applied.field,
          vesicle.inside.conductivity,
          applied.conductivity,
          applied.permittivity,
          vesicle.inside.permittivity_ratio,
          applied.waveform,
          applied.displacement_current,
          applied.averaged_frequency,
          vesicle.pump ? 1.0 : 0.0,
          vesicle.pump.value_or(Waveform{})};
}

}  // namespace vehd

#include "bie/stepping/state/model.hpp"

namespace vehd {

FlowParameters flow_parameters(const Model& model, const VesicleModel& vesicle) {
  return {model.viscosity, vesicle.viscosity_ratio, vesicle.inextensible, vesicle.bending};
}

ElectricParameters electric_parameters(const Model& model, const VesicleModel& vesicle) {
  const AppliedField& applied = *model.electric;
  return {applied.field,        vesicle.inside.conductivity,       applied.conductivity,
          applied.permittivity, vesicle.inside.permittivity_ratio, applied.waveform};
}

}  // namespace vehd

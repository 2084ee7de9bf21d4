#include <string_view>

#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"

namespace vehd {

void check_poration(const Scene& scene, const TomlFile& file) {
  if (!scene.poration) return;
  const PorationScene& poration = *scene.poration;
  const auto refuse_if = [&](bool is_wrong, std::string_view key, std::string_view problem) {
    if (is_wrong) file.refuse_key("poration", key, "{}", problem);
  };
  refuse_if(has_averaged_field(scene), "model",
            "\"average\" in [electric.waveform] is true with [poration], which needs V_m at every time; accepted: "
            "false");
  if (poration.model == PorationModel::criterion) {
    refuse_if(!poration.threshold_potential && !poration.lysis_tension, "model",
              "missing key \"threshold_Vm\" or \"lysis_tension\" in [poration]; accepted: one or both");
    refuse_if(poration.threshold_potential && !scene.electric, "threshold_Vm",
              "\"threshold_Vm\" in [poration] has no effect without [electric]");
    if (!poration.lysis_tension) return;
    refuse_if(!(scene.membrane.inextensible && scene.membrane.mobile), "lysis_tension",
              "\"lysis_tension\" in [poration] has no effect without a tension; accepted: \"inextensible\" and "
              "\"mobile\" in [membrane] true");
    refuse_if(!scene.membrane.undulations && is_sphere(initial_position(scene)), "lysis_tension",
              "\"lysis_tension\" in [poration] of a sphere: a uniform tension of any size moves nothing there, so the "
              "tension is not determined; accepted: another [shape], \"undulations\" in [membrane], or "
              "\"threshold_Vm\" alone");
    return;
  }
  refuse_if(!scene.electric, "model", "[poration] has no effect without [electric]; accepted: model = criterion");
  const ElectricScene& electric = *scene.electric;
  refuse_if(electric.initial_potential == InitialPotential::steady, "model",
            "[poration] with a steady \"initial_Vm\" in [electric], under which a membrane would porate at once; "
            "accepted: zero or file");
  if (poration.model == PorationModel::porosity && poration.resealing_time <= poration.poration_time) {
    file.refuse_key("poration", "resealing_time",
                    "\"resealing_time\" in [poration] is {}; accepted: more than the \"poration_time\" {}",
                    file.typed("poration.resealing_time"), file.typed("poration.poration_time"));
  }
  refuse_if(poration.model == PorationModel::pores && !poration.pore_conductivity &&
                (electric.conductivity_in == 0.0 || electric.conductivity_out == 0.0),
            "model",
            "missing key \"pore_conductivity\" in [poration]: a conductivity in [electric] is 0; accepted: > 0");
}

}  // namespace vehd

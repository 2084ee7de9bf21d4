#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/electric_field.hpp"
#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/poiseuille_flow.hpp"
#include "bie/physics/effects/spontaneous_curvature.hpp"
#include "bie/physics/effects/tension.hpp"
#include "bie/physics/effects/undulations.hpp"
#include "bie/physics/effects/wall_effect.hpp"
#include "bie/physics/model.hpp"

namespace vehd {

namespace {

class DescribedEffect : public Effect {
 public:
  explicit DescribedEffect(EffectDescription (*made)()) : made_(made) {}
  [[nodiscard]] EffectDescription description() const override { return made_(); }

 private:
  EffectDescription (*made_)();
};

}  // namespace

MadeEffect described(EffectDescription (*description)()) { return std::make_shared<DescribedEffect>(description); }

std::vector<EffectRow> effect_table() {
  return {bending_row(),           tension_row(),
          undulations_row(),       viscosity_contrast_row(),
          applied_field_row(),     poration_row(),
          spatial_variation_row(), pump_row(),
          background_flow_row(),   {SpontaneousCurvatureEffect::kName},
          {GravityEffect::kName},  {PoiseuilleFlowEffect::kName},
          contact_row(),           wall_row()};
}

}  // namespace vehd

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bie/physics/effects/background_flow.hpp"
#include "bie/physics/effects/contact.hpp"
#include "bie/physics/effects/poration.hpp"
#include "bie/physics/parameters.hpp"
#include "bie/physics/wall.hpp"

namespace vehd {

/// One vesicle: its membrane and the fluid within.
struct VesicleModel {
  double viscosity_ratio = 1.0;  ///< μ_i/μ_e; at 1 there is no Stokes double layer
  bool inextensible = true;
  std::optional<Undulations> undulations{};  ///< of an inextensible membrane that bends; absent: its area is constant
  std::optional<BendingParameters> bending;
  InnerDielectric inside;                              ///< used only with Model::electric, as is charging
  ChargingParameters charging;                         ///< of the membrane
  std::optional<PorationCriterion> criterion{};        ///< reported in the history
  std::shared_ptr<const PorationReaction> reaction{};  ///< null: poration does not change the conductance
  bool has_varying_properties = false;  ///< some properties vary over the membrane, see SurfaceFields::material
  std::optional<Waveform> pump{};       ///< of the pump current; empty without a pump
  /// Effects on this vesicle only: gravity, spontaneous curvature, …
  std::vector<std::shared_ptr<const ExplicitEffect>> effects;
};

/// The effects that are present; an empty optional means that nothing of the effect is assembled or evaluated.
struct Model {
  double viscosity = 1.0;  ///< μ_e, of the fluid around the vesicles
  std::optional<BackgroundFlow> flow;
  std::optional<AppliedField> electric;
  std::optional<ContactParameters> contact;  ///< between vesicles
  std::optional<Wall> wall{};                ///< beside all vesicles
  /// Other effects on every vesicle: Poiseuille flow, …
  std::vector<std::shared_ptr<const ExplicitEffect>> effects;
  bool mobile = true;  ///< false: the shapes are frozen and only the membranes charge
  std::vector<VesicleModel> vesicles = std::vector<VesicleModel>(1);
};

/// Fluids and membrane of one vesicle, for its velocity.
FlowParameters flow_parameters(const Model& model, const VesicleModel& vesicle);

/// Is the field averaged over a period? Then V_m follows from the shapes and is not an unknown.
bool is_averaged(const Model& model);

/// Does free charge of both faces relax in time? Then V_m is not part of the state.
bool relaxes_charge(const Model& model);

/// Electric problem of one vesicle, with the waveforms; the model must have a field.
ElectricParameters electric_parameters(const Model& model, const VesicleModel& vesicle);

}  // namespace vehd

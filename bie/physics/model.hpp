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
  InnerDielectric inside;                              ///< counts with Model::electric alone, as charging does
  ChargingParameters charging;                         ///< of the membrane
  std::optional<PorationCriterion> criterion{};        ///< of which a history tells
  std::shared_ptr<const PorationReaction> reaction{};  ///< null: the membrane conducts as much as ever
  bool by_place = false;           ///< some properties differ from place to place, see SurfaceFields::material
  std::optional<Waveform> pump{};  ///< of the pump current; empty without a pump
  /// Effects on this vesicle alone: gravity, spontaneous curvature, …
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

/// The fluids and the membrane that one vesicle moves with.
FlowParameters flow_parameters(const Model& model, const VesicleModel& vesicle);

/// Is there a field of which only the mean over a period counts? V_m follows from the shapes then and is no unknown.
bool is_averaged(const Model& model);

/// Does free charge of both faces relax in time, so that V_m is no part of the state?
bool relaxes_charge(const Model& model);

/// The electric problem of one vesicle, the waveform with it; the model must have a field.
ElectricParameters electric_parameters(const Model& model, const VesicleModel& vesicle);

}  // namespace vehd

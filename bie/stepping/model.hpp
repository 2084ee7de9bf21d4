#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bie/physics/background_flow.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

/// The effects that are present; an empty optional means that nothing of the effect is assembled or evaluated.
struct Model {
  double viscosity = 1.0;        ///< μ_e, outside
  double viscosity_ratio = 1.0;  ///< μ_i/μ_e; at 1 there is no Stokes double layer
  bool inextensible = true;
  std::optional<BendingParameters> bending;
  std::optional<BackgroundFlow> flow;
  std::optional<ElectricParameters> electric;
  std::optional<ChargingParameters> charging;  ///< present exactly when `electric` is
  /// Whatever else acts explicitly: gravity, Poiseuille flow, spontaneous curvature, …
  std::vector<std::shared_ptr<const ExplicitEffect>> effects;
  bool mobile = true;  ///< false: the shape is frozen and only the membrane charges
};

}  // namespace vehd

#pragma once

#include <functional>

#include "bie/stepping/state/field_table.hpp"

namespace vehd {

/// What a motion over dt makes of one membrane.
struct Motion {
  SurfaceFields material;  ///< at the material points
  SurfaceFields arrived;   ///< at the nodes where the motion ends, see Arrival
  double raw_area = 0.0;   ///< relative area error of the start's own velocity, before the constraint takes it out
  /// Root mean square over the radius of what the material had to be moved by so that area and volume hold at the nodes
  /// as well: the degree does not hold the same surface on another grid.
  double arrival_shift = 0.0;
};

template <MaybeConst<Motion> Sent, typename Visit>
void visit_members(Sent& motion, Visit& visit) {
  auto& [material, arrived, raw_area, arrival_shift] = motion;
  visit(material, arrived, raw_area, arrival_shift);
}

/// Takes the fields at the material points to the nodes where a motion ends: new ones at the end of a step, the
/// material points themselves within it.
using Arrival = std::function<SurfaceFields(const SurfaceFields& material)>;

}  // namespace vehd

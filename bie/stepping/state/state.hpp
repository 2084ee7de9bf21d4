#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bie/stepping/state/first_crossing.hpp"
#include "bie/stepping/state/recycled_subspaces.hpp"
#include "bie/stepping/state/surface_fields.hpp"

namespace vehd {

/// One membrane of a state.
struct VesicleState : SurfaceFields {
  double reference_area = 0.0;  ///< area and volume that its constraint holds
  double reference_volume = 0.0;
  std::optional<FirstCrossing> crossing{};  ///< of a membrane with a criterion of poration
  std::int64_t quadrature_level = 0;        ///< how often its quadrature has been made finer, see Evolution
  RecycledSubspaces recycled;
  Matrix past{};  ///< columns_of its Unknowns at each of State::past_times less those now, at the same material points
};

/// Everything that one step hands to the next; a checkpoint stores exactly these values.
struct State {
  double time = 0.0;
  std::int64_t step = 0;  ///< accepted steps so far
  double dt_next = 0.0;   ///< step size the controller tries next
  double dt_found = 0.0;  ///< the size that the error of the last step asks for; 0: that was not told
  std::vector<VesicleState> vesicles;
  Vector past_times{};  ///< of the nodes of the last step before its end, less `time`: ascending; empty: not known
};

/// The same without the nodes of the last step: the next one begins with first-order steps.
inline State without_past(State state) {
  state.past_times = {};
  for (VesicleState& vesicle : state.vesicles) vesicle.past = {};
  return state;
}

}  // namespace vehd

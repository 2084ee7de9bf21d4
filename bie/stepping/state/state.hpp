#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bie/stepping/state/first_crossing.hpp"
#include "bie/stepping/state/recycled_subspaces.hpp"
#include "bie/stepping/state/surface_fields.hpp"

namespace vehd {

/// How the next step may begin, of a run with a tolerance, see controlled_sweeps.
struct Past {
  Vector times;                 ///< of VesicleState::past, less State::time: ascending; empty: not known
  std::int64_t is_continued{};  ///< 1: the next step begins with it; 0: with first-order steps
  double afresh_dt = 0.0;       ///< of the last step that began with first-order steps
  Vector afresh_errors;         ///< that step's after sweep 1, 2, …, over that of an explicit Euler step
};

/// One membrane of a state.
struct VesicleState : SurfaceFields {
  double reference_area = 0.0;  ///< area and volume that its constraint holds
  double reference_volume = 0.0;
  std::optional<FirstCrossing> crossing{};  ///< of a membrane with a criterion of poration
  std::int64_t quadrature_level = 0;        ///< how often its quadrature has been made finer, see Evolution
  RecycledSubspaces recycled;
  Matrix past{};  ///< unknowns() at each of the times of Past less those now, at the same material points
};

/// Everything that one step hands to the next; a checkpoint stores exactly these values.
struct State {
  double time = 0.0;
  std::int64_t step = 0;  ///< accepted steps so far
  double dt_next = 0.0;   ///< step size the controller tries next
  double dt_found = 0.0;  ///< the one that it made of the last step by its estimate alone; 0: that was not told
  std::vector<VesicleState> vesicles;
  Past past{};
};

/// The same without what it knows of the step before: the next one begins afresh.
inline State without_past(State state) {
  state.past = {};
  for (VesicleState& vesicle : state.vesicles) vesicle.past = {};
  return state;
}

}  // namespace vehd

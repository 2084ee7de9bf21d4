#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/recycled_subspaces.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// When and where a membrane has first met the criterion of poration.
struct FirstCrossing {
  double time = std::numeric_limits<double>::infinity();                        ///< infinite until then
  Vector3 place = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< in the coordinates of the state
};

/// One membrane of a state.
struct VesicleState : SurfaceFields {
  double reference_area = 0.0;  ///< area and volume that its constraint holds
  double reference_volume = 0.0;
  std::optional<FirstCrossing> crossing{};  ///< of a membrane with a criterion of poration
  std::int64_t quadrature_level = 0;        ///< how often its quadrature has been made finer, see Evolution
  RecycledSubspaces recycled;
  Matrix past{};  ///< columns_of its Unknowns at each of State::past_times less those now, at the same material points

  /// √(area/4π).
  [[nodiscard]] double radius() const { return std::sqrt(reference_area / (4.0 * std::numbers::pi)); }
};

/// Everything that one step hands to the next; a checkpoint stores exactly these values.
struct State {
  double time = 0.0;
  std::int64_t step = 0;  ///< accepted steps so far
  double dt_next = 0.0;   ///< step size the controller tries next
  double dt_found = 0.0;  ///< the size that the error of the last step allows; 0: unknown
  std::vector<VesicleState> vesicles;
  Vector
      past_times{};  ///< of the nodes of the last step before its end, less `time`: ascending; empty: none are stored
};

/// A state without the nodes of the last step: the next one begins with first-order steps.
inline State without_past(State state) {
  state.past_times = {};
  for (VesicleState& vesicle : state.vesicles) vesicle.past = {};
  return state;
}

/// The fields of a vesicle in degrees up to `order`: truncated, or padded with zeros. A membrane of another degree than
/// before has nothing to recycle, see RecycledScalars.
VesicleState resized(VesicleState vesicle, int order);
/// Solved fields of a membrane in degrees up to `order`.
VesicleFields resized(VesicleFields fields, int order);
/// Every membrane in degrees up to `order`.
State resized(State state, int order);
/// The fields of every membrane likewise.
Fields resized(Fields fields, int order);

/// Degree of the vesicle that has the highest.
int highest_order_of(const State& state);

/// Largest difference of coefficients of x and of V_m, each over its largest coefficient.
/// @return  a share; both states must have the same degrees
double state_difference(const State& state, const State& reference);

}  // namespace vehd

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
  double reference_area = 0.0;  ///< area and volume that its constraint keeps
  double reference_volume = 0.0;
  std::optional<FirstCrossing> crossing{};  ///< of a membrane with a criterion of poration
  std::int64_t quadrature_level = 0;        ///< refinements of its quadrature, see Evolution
  RecycledSubspaces recycled;
  Matrix past{};  ///< columns_of its Unknowns at State::past_times minus those now, at the same material points

  /// √(area/4π).
  [[nodiscard]] double radius() const { return std::sqrt(reference_area / (4.0 * std::numbers::pi)); }
};

/// Everything that one step passes to the next; a checkpoint stores exactly these values.
struct State {
  double time = 0.0;
  std::int64_t step = 0;  ///< accepted steps so far
  double dt_next = 0.0;   ///< step size the controller tries next
  double dt_found = 0.0;  ///< the size that the error of the last step allows; 0: unknown
  std::vector<VesicleState> vesicles;
  Vector past_times{};  ///< of start and inner nodes of the last step, minus `time`: ascending, or empty
};

/// The state without the nodes of the last step: the next one uses the Euler predictor.
inline State without_past(State state) {
  state.past_times = {};
  for (VesicleState& vesicle : state.vesicles) vesicle.past = {};
  return state;
}

/// The fields of a vesicle in degrees up to `order`: truncated, or padded with zeros. A change of degree drops the
/// recycled subspaces, see RecycledScalars.
VesicleState resized(VesicleState vesicle, int order);
/// Solved fields of a membrane in degrees up to `order`.
VesicleFields resized(VesicleFields fields, int order);
/// Every membrane in degrees up to `order`.
State resized(State state, int order);
/// Solved fields of every membrane in degrees up to `order`.
Fields resized(Fields fields, int order);

/// Degree of the vesicle that has the highest.
int highest_order_of(const State& state);

/// Largest difference of the coefficients of each unknown, over its largest coefficient.
/// @return  relative difference; both states must have the same degrees
double state_difference(const State& state, const State& reference);

}  // namespace vehd

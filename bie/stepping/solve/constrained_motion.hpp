#pragma once

#include <functional>

#include "bie/physics/membrane.hpp"
#include "bie/stepping/solve/flow_system.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// One membrane after a motion over dt.
struct Motion {
  SurfaceFields material;  ///< at the material points
  SurfaceFields arrived;   ///< at the nodes where the motion ends, see Arrival
  double raw_area = 0.0;   ///< relative area error of the initial velocity, before the constraint removes it
  /// Root-mean-square displacement of the material, over the radius, that makes area and volume hold at the nodes as
  /// well: on another grid the degree does not represent the same surface.
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

/// Start of a motion.
struct MotionStart {
  SurfaceFields fields;  ///< x and λ before the motion, V_m after it
  Matrix velocity;       ///< before the implicit increments, [n_coefficients x 3]
};

/// Data common to all motions of one membrane in a step.
struct MotionContext {
  const FlowParameters& parameters;
  const NumericalSettings& settings;
  const VesicleState& state;  ///< at the start of the step: strain and the area and volume to hold
  const Membrane& membrane;   ///< at the start of the step
};

/// Solves (27) for x^{n+1}: the velocity of the start plus the implicit increments, for the operators at the start of
/// the step. The first-order step starts from x^n with its velocity; deferred corrections start from an approximation
/// of x^{n+1} with a velocity that would remove its residual. The right-hand side of the constraint, zero in (27b), is
/// iterated until the step as a whole (not only its tangent) keeps the area of every membrane element and takes back
/// the strain of former steps up to thresholds::known_strain; a uniform normal velocity removes the volume error of the
/// step. Area and volume are those of the shape on arrival, so that truncation there is corrected as well.
/// @param flow        the linearised system of this membrane and this dt
/// @param iterations  increased by those of the flow solves
/// @throws ConvergenceError if no such motion is found
/// Accuracy: area and volume to the tolerance of the constraint, 1e-9 by default
/// (tests/stepping/time/step_control_test.cpp)
///
/// With undulations the constraint keeps the dilation uniform over all area elements, and the area on arrival is that
/// of AreaLaw under the mean tension at y, which follows from the area there, plus the increment of the mean tension.
/// Source: paper Eqs. (27), (28); the iterated right-hand side of (27b) is of this project
Motion constrained_motion(const MotionContext& context, const MotionStart& start, double dt, FlowSystem& flow,
                          const Arrival& arrival, int& iterations);

}  // namespace vehd

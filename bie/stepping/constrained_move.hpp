#pragma once

#include <functional>
#include <string>

#include "bie/stepping/evaluation_parts.hpp"
#include "bie/stepping/flow_solve.hpp"

namespace vehd {

class Discretisation;

/// Displacement of the membrane over one step with area and volume held, or the reason why there is none.
struct ConstrainedMove {
  bool accepted = false;
  std::string reason;
  Matrix position;        ///< x^{n+1} at the material nodes, coefficients
  Vector tension;         ///< λ^{n+1}
  Vector area_strain;     ///< W/W_ref − 1 after the step, coefficients
  double raw_area = 0.0;  ///< relative area error of the start's own velocity, before the constraint takes it out
  Matrix landed;          ///< what `landing` made of the move
  int iterations = 0;
};

/// Where a move starts from.
struct MoveStart {
  Matrix position;  ///< coefficients
  Matrix velocity;  ///< before the implicit increments
  Vector tension;
};

/// Turns a move into the fields of the new state, coefficients with x in the first three columns.
using Landing = std::function<Matrix(const ConstrainedMove&)>;

/// Solves (27) for x^{n+1}: the velocity of the start plus the implicit increments, for the operators of `parts`. The
/// first-order step starts from x^n with its velocity; deferred corrections start from an approximation of x^{n+1}
/// with a velocity that would remove its residual. The right-hand side of the
/// constraint, zero in (27b), is iterated until the step as a whole (not only its tangent) keeps the area of every
/// membrane element; a uniform normal velocity of the size of the step's volume error accompanies it. Area and volume
/// are those of the landed shape, so that what truncation costs in `landing` is answered for as well.
/// @param flow  the linearised system of these parts and this dt
ConstrainedMove constrained_move(const Model& model, const Discretisation& discretisation, const State& state,
                                 const Evaluation::Parts& parts, const MoveStart& start, double dt, FlowSystem& flow,
                                 const Landing& landing);

}  // namespace vehd

#pragma once

#include <string>

#include "bie/stepping/evaluation_parts.hpp"

namespace vehd {

class Discretisation;

/// Displacement of the membrane over one step with area and volume held, or the reason why there is none.
struct ConstrainedMove {
  bool accepted = false;
  std::string reason;
  Matrix position;     ///< x^{n+1} at the material nodes, coefficients
  Matrix velocity;     ///< (x^{n+1} − x^n)/dt
  Vector tension;      ///< λ^{n+1}
  Vector area_strain;  ///< W/W_ref − 1 after the step, coefficients
  int iterations = 0;
};

/// Solves (27) for x^{n+1}: the velocity of the evaluation plus the implicit increments. The right-hand side of the
/// constraint, zero in (27b), is iterated until the step as a whole (not only its tangent) keeps the area of
/// every membrane element; a uniform normal velocity of the size of the step's volume error accompanies it.
ConstrainedMove constrained_move(const Model& model, const Discretisation& discretisation, const State& state,
                                 const Evaluation::Parts& parts, const Vector& tension, double dt);

}  // namespace vehd

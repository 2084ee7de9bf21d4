#pragma once

#include "bie/physics/electric.hpp"
#include "bie/stepping/stepper.hpp"

namespace vehd {

/// What a step needs of the evaluation that precedes it.
struct Evaluation::Parts {
  Membrane membrane;
  Matrix velocity;         ///< instantaneous, coefficients; empty where the shape is frozen
  bool is_sphere = false;  ///< see uniform_tension_is_free
};

}  // namespace vehd

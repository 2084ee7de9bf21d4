#pragma once

#include <cstdint>

#include "bie/stepping/flow_memory.hpp"

namespace vehd {

/// Everything that one step hands to the next; a checkpoint stores exactly these values.
/// Fields are spherical-harmonic coefficients of degree p, index n² + n + m (docs/conventions.md).
struct State {
  double time = 0.0;
  std::int64_t step = 0;              ///< accepted steps so far
  double dt_next = 0.0;               ///< step size the controller tries next
  std::int64_t quadrature_level = 0;  ///< how often the quadrature has been made finer, see Evolution
  Matrix position;                    ///< x, [n_coefficients x 3]
  Vector transmembrane_potential;     ///< V_m; empty without electricity
  Vector tension;                     ///< λ, initial guess of the next solve; empty unless inextensible
  Vector area_strain;                 ///< W/W_ref − 1 of the material at each node
  double reference_area = 0.0;        ///< area and volume that the constraint holds
  double reference_volume = 0.0;
  FlowMemory flow_memory;
};

}  // namespace vehd

#pragma once

#include "bie/physics/membrane_material.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// What rides on the material points of one membrane, in spherical-harmonic coefficients of one degree, index
/// n² + n + m (docs/conventions.md). Fields of absent effects are empty.
struct SurfaceFields {
  Matrix position;     ///< x, [n_coefficients x 3]
  Vector area_strain;  ///< W/W_ref − 1
  /// V_m, interior minus exterior; empty without electricity. With displacement currents the charge of the inner face
  /// over C_m, which is continuous where the field jumps, see FaceCharges.
  Vector transmembrane_potential;
  Vector free_charge;           ///< of both faces over C_m; empty without displacement currents
  Vector tension;               ///< λ, also the initial guess of the next solve; empty unless inextensible
  Vector poration{};            ///< s of the membrane's PorationReaction; empty without
  MembraneMaterial material{};  ///< what differs from place to place
};

}  // namespace vehd

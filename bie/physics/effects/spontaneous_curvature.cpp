#include "bie/physics/effects/spontaneous_curvature.hpp"

namespace vehd {

EffectDescription SpontaneousCurvatureEffect::description() const {
  return {kName, "f_c = -2 kappa_B c (K - c H) n", {{&LayerSelection::stokes_single, "velocity of f_c, Eq. (5)"}}, {}};
}

void SpontaneousCurvatureEffect::add(const EffectInput& input, Forcing& forcing) const {
  const Surface& s = input.membrane.surface;
  const double c = parameters_.curvature;
  const Vector magnitude = -2.0 * parameters_.bending_modulus * c * (s.gauss_curvature - c * s.mean_curvature);
  forcing.force += magnitude.asDiagonal() * s.normal;
}

}  // namespace vehd

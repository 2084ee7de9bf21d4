#include "bie/physics/effects/gravity.hpp"

#include "bie/physics/rotated.hpp"

namespace vehd {

EffectDescription GravityEffect::description() const {
  return {kName, "f_g = (rho_i - rho_e)(g.x) n", {{&LayerSelection::stokes_single, "velocity of f_g, Eq. (5)"}}, {}};
}

void GravityEffect::add(const EffectInput& input, Forcing& forcing) const {
  const Surface& s = input.membrane.surface;
  // A constant added to g·x only changes the pressure; from the centroid the heights stay small.
  const Vector3 centre = centroid(s);
  const Vector height = (s.position.rowwise() - centre.transpose()) * parameters_.acceleration;
  forcing.force += (parameters_.density_difference * height).asDiagonal() * s.normal;
}

bool GravityEffect::is_invariant_under(const Reflection& g) const {
  for (int i = 0; i < 3; ++i) {
    if (g.sign(i) < 0 && parameters_.acceleration[i] != 0.0) return false;
  }
  return true;
}

bool GravityEffect::is_axisymmetric() const {
  return parameters_.acceleration.x() == 0.0 && parameters_.acceleration.y() == 0.0;
}

std::shared_ptr<const ExplicitEffect> GravityEffect::rotated(const Matrix3& rotation) const {
  return std::make_shared<GravityEffect>(
      GravityParameters{parameters_.density_difference, rotated_vector(rotation, parameters_.acceleration)});
}

std::vector<Vector3> GravityEffect::axis_candidates() const { return {parameters_.acceleration}; }

}  // namespace vehd

#include "bie/physics/poiseuille_flow.hpp"

namespace vehd {

EffectDescription PoiseuilleFlowEffect::description() const {
  return {"Poiseuille flow", "v_inf = v_c (1 - (y^2 + z^2)/R^2) e_x on the right of Eq. (5)", {}, {}};
}

void PoiseuilleFlowEffect::add(const Situation& situation, Forcing& forcing) const {
  const Matrix& x = situation.membrane.surface.position;
  const Eigen::ArrayXd off_axis = (x.col(1).array().square() + x.col(2).array().square());
  const double amplitude = parameters_.centre_velocity * parameters_.waveform.at(situation.time, situation.limit);
  const Vector profile = amplitude * (1.0 - off_axis / (parameters_.radius * parameters_.radius));
  forcing.velocity.col(0) += situation.membrane.fine.analyze(profile);
}

bool PoiseuilleFlowEffect::allows(const Reflection& g) const { return g.x > 0; }

bool PoiseuilleFlowEffect::allows_axis() const { return false; }

std::optional<double> PoiseuilleFlowEffect::next_corner(double time) const {
  return parameters_.waveform.next_corner(time);
}

}  // namespace vehd

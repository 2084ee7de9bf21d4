#include "bie/physics/effects/poiseuille_flow.hpp"

#include "bie/physics/rotated.hpp"

namespace vehd {

EffectDescription PoiseuilleFlowEffect::description() const {
  return {kName,
          parameters_.across ? "v_inf = v_c (1 - z^2/R^2) e_x on the right of Eq. (5)"
                             : "v_inf = v_c (1 - (y^2 + z^2)/R^2) e_x on the right of Eq. (5)",
          {},
          {}};
}

void PoiseuilleFlowEffect::add(const EffectInput& input, Forcing& forcing) const {
  const Matrix& x = input.membrane.surface.position;
  const Vector3& d = parameters_.direction;
  const Matrix off_axis = parameters_.across ? Matrix(x * *parameters_.across) : Matrix(x - (x * d) * d.transpose());
  const double amplitude = parameters_.centre_velocity * parameters_.waveform.at(input.time, input.limit);
  const Vector profile =
      amplitude * (1.0 - off_axis.rowwise().squaredNorm().array() / (parameters_.radius * parameters_.radius));
  forcing.velocity += input.membrane.fine.analyze(profile) * d.transpose();
}

bool PoiseuilleFlowEffect::is_invariant_under(const Reflection& g) const {
  for (int i = 0; i < 3; ++i) {
    if (g.sign(i) < 0 && parameters_.direction[i] != 0.0) return false;
  }
  if (!parameters_.across) return true;
  const Vector3& m = *parameters_.across;
  const Vector3 image = m.cwiseProduct(Vector3(g.x, g.y, g.z));
  return image == m || image == -m;
}

bool PoiseuilleFlowEffect::is_axisymmetric() const {
  return !parameters_.across && parameters_.direction.x() == 0.0 && parameters_.direction.y() == 0.0;
}

std::shared_ptr<const ExplicitEffect> PoiseuilleFlowEffect::rotated(const Matrix3& rotation) const {
  PoiseuilleParameters result = parameters_;
  result.direction = rotated_vector(rotation, parameters_.direction);
  if (result.across) result.across = rotated_vector(rotation, *result.across);
  return std::make_shared<PoiseuilleFlowEffect>(result);
}

std::vector<Vector3> PoiseuilleFlowEffect::axis_candidates() const { return {parameters_.direction}; }

std::optional<double> PoiseuilleFlowEffect::next_discontinuity(double time) const {
  return parameters_.waveform.next_discontinuity(time);
}

bool PoiseuilleFlowEffect::jumps_at(double time) const { return parameters_.waveform.jumps_at(time); }

}  // namespace vehd

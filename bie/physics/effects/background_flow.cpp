#include "bie/physics/effects/background_flow.hpp"

#include "bie/physics/model.hpp"
#include "bie/physics/rotated.hpp"
#include "bie/sphere/principal_axes.hpp"

namespace vehd {

namespace {

constexpr const char* kBackgroundFlow = "background flow";

}  // namespace

BackgroundFlow shear_flow(double rate) {
  BackgroundFlow flow;
  flow.gradient(0, 2) = rate;
  return flow;
}

BackgroundFlow planar_extension(double rate) {
  BackgroundFlow flow;
  flow.gradient(0, 0) = rate;
  flow.gradient(2, 2) = -rate;
  return flow;
}

BackgroundFlow axisymmetric_extension(double rate) {
  BackgroundFlow flow;
  flow.gradient.diagonal() << -0.5 * rate, -0.5 * rate, rate;
  return flow;
}

EffectRow background_flow_row() {
  return {kBackgroundFlow, nullptr, [](Model& model, VesicleModel&) { model.flow.reset(); }};
}

Vector3 vorticity(const BackgroundFlow& flow) {
  const Matrix3& g = flow.gradient;
  return {g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1)};
}

EffectDescription LinearFlowEffect::description() const {
  return {kBackgroundFlow, "v_inf = gradient x on the right of Eq. (5)", {}, {}};
}

void LinearFlowEffect::add(const EffectInput& input, Forcing& forcing) const {
  forcing.velocity += flow_.waveform.at(input.time, input.limit) * input.position * flow_.gradient.transpose();
}

bool LinearFlowEffect::is_invariant_under(const Reflection& g) const {
  const Matrix3& a = flow_.gradient;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (a(i, j) != 0.0 && g.sign(i) * g.sign(j) < 0) return false;
    }
  }
  return true;
}

namespace {

/// Equality up to rounding: rotation to an oblique axis perturbs equal entries differently.
bool are_equal(const Matrix3& a, const Matrix3& b) {
  constexpr double kRounding = 1e-14;
  return (a - b).cwiseAbs().maxCoeff() <= kRounding * a.cwiseAbs().maxCoeff();
}

}  // namespace

bool LinearFlowEffect::is_axisymmetric() const {
  Matrix3 axisymmetric = Matrix3::Zero();
  axisymmetric.diagonal() << flow_.gradient(0, 0), flow_.gradient(0, 0), flow_.gradient(2, 2);
  return are_equal(flow_.gradient, axisymmetric);
}

bool LinearFlowEffect::is_invariant_under_rotations() const {
  const Matrix3& a = flow_.gradient;
  Matrix3 swirling = Matrix3::Zero();
  swirling << a(0, 0), a(0, 1), 0.0, -a(0, 1), a(0, 0), 0.0, 0.0, 0.0, a(2, 2);
  return are_equal(a, swirling);
}

std::shared_ptr<const ExplicitEffect> LinearFlowEffect::rotated(const Matrix3& rotation) const {
  return std::make_shared<LinearFlowEffect>(BackgroundFlow{rotated_tensor(rotation, flow_.gradient), flow_.waveform});
}

std::vector<Vector3> LinearFlowEffect::axis_candidates() const {
  const Matrix3 axes = principal_axes(0.5 * (flow_.gradient + flow_.gradient.transpose())).directions;
  return {axes.col(0), axes.col(1), axes.col(2)};
}

std::optional<double> LinearFlowEffect::next_discontinuity(double time) const {
  return flow_.waveform.next_discontinuity(time);
}

bool LinearFlowEffect::jumps_at(double time) const { return flow_.waveform.jumps_at(time); }

}  // namespace vehd

#pragma once

#include "bie/physics/effects/effect.hpp"
#include "bie/physics/waveform.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Linear background flow v_∞(x, t) = waveform(t) gradient x, gradient(i, j) = dv_i/dx_j, trace zero.
/// Gradient in 1/time.
/// Source: paper Eq. (1c)
struct BackgroundFlow {
  Matrix3 gradient = Matrix3::Zero();
  Waveform waveform{};
};

/// v = rate (z, 0, 0): flow along x, gradient along z.
/// Accuracy: exact (tests/physics/background_flow_test.cpp)
BackgroundFlow shear_flow(double rate);
/// v = rate (x, 0, -z).
/// Accuracy: exact (tests/physics/background_flow_test.cpp)
BackgroundFlow planar_extension(double rate);
/// v = rate (-x/2, -y/2, z).
/// Accuracy: exact (tests/physics/background_flow_test.cpp)
BackgroundFlow axisymmetric_extension(double rate);

/// ∇ × v_∞ at waveform 1, in 1/time.
Vector3 vorticity(const BackgroundFlow& flow);

/// Adds v_∞(x) of a BackgroundFlow to the velocity of the undisturbed fluid: linear in x, hence exact in coefficients.
/// Source: paper Eqs. (1c), (5)
class LinearFlowEffect : public ExplicitEffect {
 public:
  explicit LinearFlowEffect(BackgroundFlow flow) : flow_(std::move(flow)) {}

  [[nodiscard]] EffectDescription description() const override;
  void add(const EffectInput& input, Forcing& forcing) const override;
  [[nodiscard]] bool is_invariant_under(const Reflection& g) const override;
  [[nodiscard]] bool is_axisymmetric() const override;
  [[nodiscard]] bool is_invariant_under_rotations() const override;
  [[nodiscard]] std::shared_ptr<const ExplicitEffect> rotated(const Matrix3& rotation) const override;
  [[nodiscard]] std::vector<Vector3> axis_candidates() const override;
  [[nodiscard]] std::optional<double> next_discontinuity(double time) const override;
  [[nodiscard]] bool jumps_at(double time) const override;

 private:
  BackgroundFlow flow_;
};

/// Registration of Model::flow. It makes nothing: explicit_effects creates the effect.
EffectRow background_flow_row();

}  // namespace vehd

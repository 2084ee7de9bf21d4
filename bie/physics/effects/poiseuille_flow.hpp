#pragma once

#include "bie/physics/effects/effect.hpp"
#include "bie/physics/waveform.hpp"

namespace vehd {

/// Unbounded Poiseuille flow along a unit vector d, v = waveform(t) centre_velocity (1 − |x − (x·d) d|²/radius²) d:
/// there is no wall at `radius`, which only sets the curvature of the profile. Between planes with unit normal m the
/// profile is 1 − (x·m)²/radius² instead.
/// centre_velocity in length/time, radius in length.
struct PoiseuilleParameters {
  double centre_velocity = 1.0;
  double radius = 1.0;
  Waveform waveform{};
  Vector3 direction = Vector3::UnitX();
  std::optional<Vector3> across{};  ///< m; absent: flow through a tube
};

/// Adds the flow of PoiseuilleParameters to the velocity of the undisturbed fluid: quadratic in x, evaluated on the
/// upsampled grid and truncated to degree p.
/// Accuracy: the written profile to 1e-12 (tests/physics/explicit_effects_test.cpp)
class PoiseuilleFlowEffect : public ExplicitEffect {
 public:
  static constexpr const char* kName = "Poiseuille flow";

  explicit PoiseuilleFlowEffect(PoiseuilleParameters parameters) : parameters_(std::move(parameters)) {}

  [[nodiscard]] EffectDescription description() const override;
  void add(const EffectInput& input, Forcing& forcing) const override;
  [[nodiscard]] bool is_invariant_under(const Reflection& g) const override;
  [[nodiscard]] bool is_axisymmetric() const override;
  [[nodiscard]] std::shared_ptr<const ExplicitEffect> rotated(const Matrix3& rotation) const override;
  [[nodiscard]] std::vector<Vector3> axis_candidates() const override;
  [[nodiscard]] std::optional<double> next_discontinuity(double time) const override;
  [[nodiscard]] bool jumps_at(double time) const override;

 private:
  PoiseuilleParameters parameters_;
};

}  // namespace vehd

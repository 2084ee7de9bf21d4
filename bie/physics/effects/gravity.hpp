#pragma once

#include "bie/physics/effects/effect.hpp"

namespace vehd {

/// Body force on the inner fluid minus that on the outer one, (ρ_i − ρ_e) g. Pressure balances it within either fluid,
/// so that it acts as f_g = (ρ_i − ρ_e)(g·x) n on the membrane; the total is (ρ_i − ρ_e) g V.
/// Density difference times acceleration is a force per volume.
struct GravityParameters {
  double density_difference = 0.0;  ///< ρ_i − ρ_e
  Vector3 acceleration = Vector3::Zero();
  bool operator==(const GravityParameters&) const = default;
};

/// The force f_g of GravityParameters, per area, [n_points x 3].
/// Accuracy: rounding; the sum is (ρ_i − ρ_e) g V to 1e-10 (tests/physics/explicit_effects_test.cpp), a sphere sinks
/// with the speed of Hadamard and Rybczynski or of Stokes to 1e-9 (tests/stepping/state/composition_test.cpp)
class GravityEffect : public ExplicitEffect {
 public:
  static constexpr const char* kName = "gravity";

  explicit GravityEffect(GravityParameters parameters) : parameters_(std::move(parameters)) {}

  [[nodiscard]] const GravityParameters& parameters() const { return parameters_; }

  [[nodiscard]] EffectDescription description() const override;
  void add(const EffectInput& input, Forcing& forcing) const override;
  [[nodiscard]] bool is_invariant_under(const Reflection& g) const override;
  [[nodiscard]] bool is_axisymmetric() const override;
  [[nodiscard]] bool is_same_as(const ExplicitEffect& other) const override { return has_parameters_of(*this, other); }
  [[nodiscard]] std::shared_ptr<const ExplicitEffect> rotated(const Matrix3& rotation) const override;
  [[nodiscard]] std::vector<Vector3> axis_candidates() const override;
  [[nodiscard]] Vector3 weight() const override { return parameters_.density_difference * parameters_.acceleration; }

 private:
  GravityParameters parameters_;
};

}  // namespace vehd

#pragma once

#include "bie/physics/effect.hpp"

namespace vehd {

/// Body force on the inner fluid beyond that on the outer one, (ρ_i − ρ_e) g. As its gradient parts balance in either
/// fluid, it acts as f_g = (ρ_i − ρ_e)(g·x) n on the membrane; the total is (ρ_i − ρ_e) g V.
struct GravityParameters {
  double density_difference = 0.0;  ///< ρ_i − ρ_e
  Vector3 acceleration = Vector3::Zero();
};

class GravityEffect : public ExplicitEffect {
 public:
  explicit GravityEffect(GravityParameters parameters) : parameters_(std::move(parameters)) {}

  [[nodiscard]] EffectDescription description() const override;
  void add(const EffectInput& input, Forcing& forcing) const override;
  [[nodiscard]] bool is_invariant_under(const Reflection& g) const override;
  [[nodiscard]] bool is_axisymmetric() const override;
  [[nodiscard]] std::shared_ptr<const ExplicitEffect> rotated(const Matrix3& rotation) const override;
  [[nodiscard]] std::vector<Vector3> axis_candidates() const override;

 private:
  GravityParameters parameters_;
};

}  // namespace vehd

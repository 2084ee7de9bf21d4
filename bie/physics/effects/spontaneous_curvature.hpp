#pragma once

#include "bie/physics/effects/effect.hpp"

namespace vehd {

/// Bending energy κ_B ∫ (H − c)² dA with a preferred mean curvature c (H = −1 on the unit sphere). It adds
/// f_c = −2 κ_B c (K − c H) n to the bending force of c = 0.
/// Source: Helfrich 1973, with the sign H = −1 on the unit sphere
struct SpontaneousCurvatureParameters {
  double bending_modulus = 0.0;  ///< κ_B
  double curvature = 0.0;        ///< c
  bool operator==(const SpontaneousCurvatureParameters&) const = default;
};

/// The force f_c of SpontaneousCurvatureParameters, per area.
/// Accuracy: spectral; with bending the slope of the energy to 1e-5 (tests/physics/explicit_effects_test.cpp)
class SpontaneousCurvatureEffect : public ExplicitEffect {
 public:
  static constexpr const char* kName = "spontaneous curvature";

  explicit SpontaneousCurvatureEffect(SpontaneousCurvatureParameters parameters) : parameters_(parameters) {}

  [[nodiscard]] const SpontaneousCurvatureParameters& parameters() const { return parameters_; }

  [[nodiscard]] EffectDescription description() const override;
  void add(const EffectInput& input, Forcing& forcing) const override;
  [[nodiscard]] bool is_invariant_under(const Reflection&) const override { return true; }
  [[nodiscard]] bool is_axisymmetric() const override { return true; }
  [[nodiscard]] bool is_translation_invariant() const override { return true; }
  [[nodiscard]] bool is_same_as(const ExplicitEffect& other) const override { return has_parameters_of(*this, other); }
  [[nodiscard]] double spontaneous_curvature() const override { return parameters_.curvature; }
  [[nodiscard]] std::shared_ptr<const ExplicitEffect> rotated(const Matrix3&) const override {
    return std::make_shared<SpontaneousCurvatureEffect>(parameters_);
  }

 private:
  SpontaneousCurvatureParameters parameters_;
};

}  // namespace vehd

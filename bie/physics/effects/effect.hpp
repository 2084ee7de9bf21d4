#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "bie/physics/membrane.hpp"
#include "bie/physics/waveform.hpp"
#include "bie/sphere/reflection.hpp"

namespace vehd {

/// A layer that an effect needs, with the reason in words.
struct OperatorNeed {
  bool LayerSelection::*layer;
  std::string why;
};

/// The term that an effect adds to the model, and the layers and unknowns that it needs in a step.
struct EffectDescription {
  std::string name;
  std::string adds;  ///< the term of the model
  std::vector<OperatorNeed> operators;
  std::vector<std::string> unknowns;  ///< scalar fields of degree p that it adds to the unknowns of a step
};

/// Input of an effect: a frozen membrane at one time.
struct EffectInput {
  const Membrane& membrane;
  const Matrix& position;  ///< coefficients of x, [n_coefficients x 3]
  double time;
  Limit limit = Limit::after;  ///< which value to take if a waveform jumps at this time
};

/// Sums of the forces and flows of all effects.
struct Forcing {
  Matrix force;     ///< on the fluid per area, values on the upsampled grid, [n_points x 3]
  Matrix velocity;  ///< of the undisturbed fluid at the membrane, coefficients, [n_coefficients x 3]
};

/// An effect of a model. By default it is invariant under translations, rotations and reflections.
class Effect {
 public:
  virtual ~Effect() = default;

  /// Its term and the operators that it needs.
  [[nodiscard]] virtual EffectDescription description() const = 0;
  /// Sign of V_m under the reflection g for which the effect is invariant; 0 if there is none.
  [[nodiscard]] virtual int potential_sign(const Reflection&) const { return 1; }
  /// Is it axisymmetric about z, without swirl?
  [[nodiscard]] virtual bool is_axisymmetric() const { return true; }
  /// Is it invariant under every rotation about z? Unlike an axisymmetric effect it can swirl.
  [[nodiscard]] virtual bool is_invariant_under_rotations() const { return is_axisymmetric(); }
  /// Is it invariant under translations?
  [[nodiscard]] virtual bool is_translation_invariant() const { return true; }
  /// Candidates for its axis of symmetry; empty if every axis is one.
  [[nodiscard]] virtual std::vector<Vector3> axis_candidates() const { return {}; }
  /// The next time after `time` at which a step should end because the effect changes abruptly.
  [[nodiscard]] virtual std::optional<double> next_discontinuity(double) const { return std::nullopt; }
  /// Does the effect differ just before and just after this time?
  [[nodiscard]] virtual bool jumps_at(double) const { return false; }
};

/// An effect that depends only on shape and time: it enters a step explicitly and adds no unknowns.
class ExplicitEffect : public Effect {
 public:
  /// Adds its force or its velocity to the sums.
  virtual void add(const EffectInput& input, Forcing& forcing) const = 0;
  /// Is the effect invariant under the reflection g?
  [[nodiscard]] virtual bool is_invariant_under(const Reflection& g) const = 0;
  [[nodiscard]] int potential_sign(const Reflection& g) const final { return is_invariant_under(g) ? 1 : 0; }
  [[nodiscard]] bool is_axisymmetric() const override = 0;
  [[nodiscard]] bool is_translation_invariant() const override { return false; }
  /// Do both effects act equally on any membrane? By default an effect equals only itself.
  [[nodiscard]] virtual bool is_same_as(const ExplicitEffect& other) const { return this == &other; }
  /// This effect rotated by R.
  [[nodiscard]] virtual std::shared_ptr<const ExplicitEffect> rotated(const Matrix3& rotation) const = 0;

  /// The mean curvature c preferred by the membrane under this effect; 0: none.
  [[nodiscard]] virtual double spontaneous_curvature() const { return 0.0; }
  /// Its force per volume on the fluid inside minus that on the fluid outside.
  [[nodiscard]] virtual Vector3 weight() const { return Vector3::Zero(); }
};

/// Is the other effect of the same class, with equal parameters?
template <typename Derived>
bool has_parameters_of(const Derived& effect, const ExplicitEffect& other) {
  return typeid(other) == typeid(Derived) && static_cast<const Derived&>(other).parameters() == effect.parameters();
}

struct Model;
struct VesicleModel;

/// An effect of a model; null if the model does not have it.
using MadeEffect = std::shared_ptr<const Effect>;

/// Registration of an effect, see effect_table. Effects stored in the lists of a model have only a name.
struct EffectRow {
  std::string_view name;
  /// Makes the effect on one vesicle of a model; null for effects that explicit_effects returns.
  MadeEffect (*made)(const Model&, const VesicleModel&) = nullptr;
  /// Removes it from a vesicle and from the model.
  void (*remove)(Model&, VesicleModel&) = nullptr;
};

/// An effect that consists only of its description, made on request.
MadeEffect described(EffectDescription (*description)());

/// Registrations of all effects.
std::vector<EffectRow> effect_table();

}  // namespace vehd

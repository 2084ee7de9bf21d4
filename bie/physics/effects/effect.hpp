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

/// The term that an effect adds to the model, and its needs in a step.
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
  Limit limit = Limit::after;  ///< which value counts where a waveform jumps at this time
};

/// Sum of the effects.
struct Forcing {
  Matrix force;     ///< on the fluid per area, values on the upsampled grid, [n_points x 3]
  Matrix velocity;  ///< of the undisturbed fluid at the membrane, coefficients, [n_coefficients x 3]
};

/// An effect that a model has. By default it does the same to a membrane wherever that is and however it is turned.
class Effect {
 public:
  virtual ~Effect() = default;

  /// Its term and the operators that it needs.
  [[nodiscard]] virtual EffectDescription description() const = 0;
  /// The sign of V_m for which the effect is its own image under the reflection g; 0 where it is for none.
  [[nodiscard]] virtual int potential_sign(const Reflection&) const { return 1; }
  /// Is it axisymmetric about z, without swirl?
  [[nodiscard]] virtual bool is_axisymmetric() const { return true; }
  /// Is it its own image under every rotation about z? Unlike an axisymmetric one it may swirl.
  [[nodiscard]] virtual bool is_invariant_under_rotations() const { return is_axisymmetric(); }
  /// Does it do the same to a membrane wherever that is?
  [[nodiscard]] virtual bool is_same_everywhere() const { return true; }
  /// Where to look for an axis about which it is axisymmetric; none where every axis is one.
  [[nodiscard]] virtual std::vector<Vector3> axis_candidates() const { return {}; }
  /// The next time after `time` at which a step should end because the effect changes abruptly.
  [[nodiscard]] virtual std::optional<double> next_discontinuity(double) const { return std::nullopt; }
  /// Is the effect another one just after this time than just before it?
  [[nodiscard]] virtual bool jumps_at(double) const { return false; }
};

/// An effect that is known once the shape and the time are: it enters a step explicitly and brings no unknowns.
class ExplicitEffect : public Effect {
 public:
  /// Adds its force or its velocity to what other effects have left there.
  virtual void add(const EffectInput& input, Forcing& forcing) const = 0;
  /// Is the effect its own image under the reflection g?
  [[nodiscard]] virtual bool is_invariant_under(const Reflection& g) const = 0;
  [[nodiscard]] int potential_sign(const Reflection& g) const final { return is_invariant_under(g) ? 1 : 0; }
  [[nodiscard]] bool is_axisymmetric() const override = 0;
  [[nodiscard]] bool is_same_everywhere() const override { return false; }
  /// Does the other one do the same to any membrane? Of effects on one vesicle alone this may tell equal ones.
  [[nodiscard]] virtual bool is_same_as(const ExplicitEffect& other) const { return this == &other; }
  /// This effect rotated by R.
  [[nodiscard]] virtual std::shared_ptr<const ExplicitEffect> rotated(const Matrix3& rotation) const = 0;

  /// The mean curvature c that it makes a membrane prefer; 0: none.
  [[nodiscard]] virtual double spontaneous_curvature() const { return 0.0; }
  /// Its force on the fluid inside beyond that on the fluid outside, per volume.
  [[nodiscard]] virtual Vector3 weight() const { return Vector3::Zero(); }
};

/// Is the other effect of the same class, and are its parameters the same?
template <typename Derived>
bool has_parameters_of(const Derived& effect, const ExplicitEffect& other) {
  return typeid(other) == typeid(Derived) && static_cast<const Derived&>(other).parameters() == effect.parameters();
}

struct Model;
struct VesicleModel;

/// An effect of a model; null where the model does not have it.
using MadeEffect = std::shared_ptr<const Effect>;

/// Registration of an effect, see effect_table. Those that stand in the lists of a model themselves have a name alone.
struct EffectRow {
  std::string_view name;
  /// The effect on one vesicle of a model, unless it is one of the model's lists.
  MadeEffect (*made)(const Model&, const VesicleModel&) = nullptr;
  /// Takes it from a vesicle and from the model.
  void (*remove)(Model&, VesicleModel&) = nullptr;
};

/// An effect that is nothing but its description, which is made where it is asked for.
MadeEffect described(EffectDescription (*description)());

/// All effects that vehd knows.
std::vector<EffectRow> effect_table();

}  // namespace vehd

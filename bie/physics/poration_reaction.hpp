#pragma once

#include "bie/physics/effect.hpp"

namespace vehd {

/// What makes a membrane conduct beyond its G_m: a number s at every material point that V_m there drives.
///
///   ds/dt = r(s, V),  current through the membrane (G_m + g(s)) V
///
/// Every function is that of one point.
class PorationReaction {
 public:
  /// A value with its slope.
  struct Slope {
    double value = 0.0;
    double slope = 0.0;
  };

  virtual ~PorationReaction() = default;

  /// s of a membrane at rest.
  [[nodiscard]] virtual double start() const = 0;
  /// g ≥ 0, conductance per area, and dg/ds ≥ 0.
  [[nodiscard]] virtual Slope conductance(double s) const = 0;
  /// r, per time.
  [[nodiscard]] virtual double rate(double s, double potential) const = 0;
  /// The s that solves s − dt r(s, V) = known, and ds/dV, which has the sign of V.
  /// @param dt  > 0, of any size
  [[nodiscard]] virtual Slope implicit_step(double known, double dt, double potential) const = 0;
  /// A potential on the way from one to another, up to which the slopes at the former still say something.
  [[nodiscard]] virtual double limited(double from, double to) const = 0;
  /// What a history tells: the porosity, or the density of pores.
  [[nodiscard]] virtual double measure(double s) const = 0;
  /// What it adds.
  [[nodiscard]] virtual EffectDescription description() const = 0;
};

}  // namespace vehd

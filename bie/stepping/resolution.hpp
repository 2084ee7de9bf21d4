#pragma once

#include "bie/physics/parameters.hpp"
#include "bie/stepping/fields.hpp"
#include "bie/stepping/model.hpp"
#include "bie/stepping/state.hpp"

namespace vehd {

/// What an error of V_m is measured by: its largest value, or a tenth of what the field could charge at most.
double potential_scale(const ElectricParameters& electric, double radius, double largest);

/// How the degrees of a state die away.
class Resolution {
 public:
  Resolution(const Model& model, const State& state);

  /// Estimate of what the degrees above p would add, in the maximum norm, to x over the radius or to V_m over its
  /// scale, whichever is more. A geometric series continues the upper half of the spectrum.
  [[nodiscard]] double remainder() const;
  /// The least even degree, from `lowest` to `highest`, whose remainder is below the target.
  [[nodiscard]] int order_for(double target, int lowest, int highest) const;

 private:
  [[nodiscard]] double remainder_at(int order) const;

  Vector bound_;        // of each degree, the larger of x and V_m; falling
  double decay_ = 0.0;  // from degree to degree
};

/// The same fields in degrees up to `order`: cut, or continued by zeros, as ScalarResponses do by themselves.
State resized(State state, int order);
Fields resized(Fields fields, int order);

}  // namespace vehd

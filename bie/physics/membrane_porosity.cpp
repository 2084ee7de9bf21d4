#include "bie/physics/membrane_porosity.hpp"

#include <algorithm>
#include <cmath>

namespace vehd {

PorationReaction::Slope MembranePorosity::target(double potential) const {
  // ½(1 + tanh x) without its cancellation far below the threshold.
  const double x = p_.steepness * (std::abs(potential) / p_.potential - 1.0);
  const double open = 1.0 / (1.0 + std::exp(-2.0 * x)), closed = 1.0 / (1.0 + std::exp(2.0 * x));
  return {open, std::copysign(2.0 * open * closed * p_.steepness / p_.potential, potential)};
}

PorationReaction::Slope MembranePorosity::conductance(double porosity) const {
  // A cut spectrum can leave less than none.
  return porosity > 0.0 ? Slope{p_.conductance * porosity, p_.conductance} : Slope{};
}

double MembranePorosity::rate(double porosity, double potential) const {
  const double missing = target(potential).value - porosity;
  return missing / (missing > 0.0 ? p_.poration_time : p_.resealing_time);
}

PorationReaction::Slope MembranePorosity::implicit_step(double known, double dt, double potential) const {
  const Slope beta = target(potential);
  // The step does not pass β, so its branch is that of where it starts.
  const double share = dt / (known < beta.value ? p_.poration_time : p_.resealing_time);
  return {(known + share * beta.value) / (1.0 + share), share / (1.0 + share) * beta.slope};
}

double MembranePorosity::limited(double from, double to) const {
  // Half of the width over which the membrane opens.
  const double width = 0.5 * p_.potential / std::max(p_.steepness, 1.0);
  return std::clamp(to, from - width, from + width);
}

EffectDescription MembranePorosity::description() const {
  EffectDescription d;
  d.name = "poration";
  d.adds = "dX/dt = max((beta - X)/tau_ep, (beta - X)/tau_res) at material points, G_m + G_1 X in place of G_m";
  d.unknowns = {"X"};
  return d;
}

}  // namespace vehd

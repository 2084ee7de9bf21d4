#include "bie/physics/effects/poration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/model.hpp"

namespace vehd {

namespace {

constexpr const char* kPoration = "poration";

}  // namespace

PorationReaction::Slope MembranePorosity::target(double potential) const {
  // ½(1 + tanh x) without its cancellation far below the threshold.
  const double x = p_.steepness * (std::abs(potential) / p_.potential - 1.0);
  const double open = 1.0 / (1.0 + std::exp(-2.0 * x)), closed = 1.0 / (1.0 + std::exp(2.0 * x));
  return {open, std::copysign(2.0 * open * closed * p_.steepness / p_.potential, potential)};
}

PorationReaction::Slope MembranePorosity::conductance(double porosity) const {
  // Truncation can make the porosity negative.
  return porosity > 0.0 ? Slope{p_.conductance * porosity, p_.conductance} : Slope{};
}

double MembranePorosity::rate(double porosity, double potential) const {
  const double missing = target(potential).value - porosity;
  return missing / (missing > 0.0 ? p_.poration_time : p_.resealing_time);
}

PorationReaction::Slope MembranePorosity::implicit_step(double known, double dt, double potential) const {
  const Slope beta = target(potential);
  // An implicit step does not overshoot β, so the sign of β − X at its start selects the branch.
  const double share = dt / (known < beta.value ? p_.poration_time : p_.resealing_time);
  return {(known + share * beta.value) / (1.0 + share), share / (1.0 + share) * beta.slope};
}

double MembranePorosity::damped_potential(double from, double to) const {
  // Half of the width over which the membrane opens.
  const double width = 0.5 * p_.potential / std::max(p_.steepness, 1.0);
  return std::clamp(to, from - width, from + width);
}

EffectDescription MembranePorosity::description() const {
  EffectDescription d;
  d.name = kPoration;
  d.adds = "dX/dt = max((beta - X)/tau_ep, (beta - X)/tau_res) at material points, G_m + G_1 X in place of G_m";
  d.unknowns = {"X"};
  return d;
}

namespace {

/// Solution u of u + exp(u) = z, by Newton's method from above, which decreases monotonically.
double log_of_product_log(double z) {
  double u = z > 1.0 ? std::log(z) : z;
  constexpr int kMost = 64;
  for (int i = 0; i < kMost; ++i) {
    const double power = std::exp(u);
    const double next = u - (u + power - z) / (1.0 + power);
    if (!(next < u)) break;
    u = next;
  }
  return u;
}

}  // namespace

double pore_conductance(double radius, double thickness, double conductivity) {
  return 2.0 * std::numbers::pi * radius * radius * conductivity / (std::numbers::pi * radius + 2.0 * thickness);
}

double pore_conductivity(double inside, double outside) {
  // (x − 1)/ln x = expm1(y)/y with y = ln x; 1 if both are equal.
  const double y = std::log(outside / inside);
  return y == 0.0 ? inside : inside * std::expm1(y) / y;
}

PorationReaction::Slope PoreDensity::conductance(double s) const {
  const double conductance = p_.pore_conductance * p_.rest_density * std::exp(s);
  return {conductance, conductance};
}

double PoreDensity::rate(double s, double potential) const {
  const double square = std::pow(potential / p_.potential, 2);
  return p_.creation_rate / p_.rest_density * (std::exp(square - s) - std::exp((1.0 - p_.exponent) * square));
}

PorationReaction::Slope PoreDensity::implicit_step(double known, double dt, double potential) const {
  const double square = std::pow(potential / p_.potential, 2);
  const double share = dt * p_.creation_rate / p_.rest_density;
  const double lost = share * std::exp((1.0 - p_.exponent) * square);
  // With w = share·exp(square − s), the ratio of new to existing pores: w + ln w = ln share + square + lost − known.
  const double log_made = log_of_product_log(std::log(share) + square + lost - known);
  const double made = std::exp(log_made);
  const double by_potential = 2.0 * potential / (p_.potential * p_.potential);
  return {known + made - lost, by_potential * (made - (1.0 - p_.exponent) * lost) / (1.0 + made)};
}

double PoreDensity::damped_potential(double from, double to) const {
  // An increase of |V| by this raises the creation rate of pores by the factor e.
  const double width = 0.5 * p_.potential * p_.potential / std::max(std::abs(from), p_.potential);
  const double change = to - from;
  // Newton's method cannot overshoot towards smaller |V|.
  if (std::abs(to) <= std::abs(from) || std::abs(change) <= 2.0 * width) return to;
  return from + std::copysign(width * (1.0 + std::log(std::abs(change) / width)), change);
}

double PoreDensity::measure(double s) const { return p_.rest_density * std::exp(s); }

EffectDescription PoreDensity::description() const {
  EffectDescription d;
  d.name = kPoration;
  d.adds =
      "dN/dt = alpha exp((V_m/V_ep)^2) [1 - (N/N_0) exp(-q (V_m/V_ep)^2)] at material points, G_m + g_p N in place of "
      "G_m";
  d.unknowns = {"ln(N/N_0)"};
  return d;
}

EffectRow poration_row() {
  return {kPoration, [](const Model&, const VesicleModel& vesicle) -> MadeEffect { return vesicle.reaction; },
          [](Model&, VesicleModel& vesicle) { vesicle.reaction.reset(); }};
}

}  // namespace vehd

#include "bie/stepping/evaluation/poration_load.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/maximum.hpp"
#include "bie/stepping/evaluation/diagnose.hpp"

namespace vehd {

namespace {

/// Largest load, with its point of the parameter sphere.
struct LoadAt {
  double load = 0.0;
  double rate = std::numeric_limits<double>::quiet_NaN();
  SpherePoint point{};
};

LoadAt of_potential(double threshold, const SphereTransform& fine, const Vector& potential, const Vector& rate) {
  // Both poles of a sphere are equal up to rounding.
  constexpr double kEqual = 1.0 + 1e-9;
  const SphereDerivatives nodes = fine.synthesize_hessian(potential);
  const Top above = top_of(fine.grid(), nodes, 0, potential, 1.0);
  const Top below = top_of(fine.grid(), nodes, 0, potential, -1.0);
  const bool is_below = below.value > kEqual * above.value;
  const Top& top = is_below ? below : above;
  LoadAt result{top.value / threshold, std::numeric_limits<double>::quiet_NaN(), top.point};
  if (rate.size() > 0) result.rate = (is_below ? -1.0 : 1.0) * value_at(top.point, rate) / threshold;
  return result;
}

/// @param varying  C_m if it varies over the membrane, coefficients, or empty
LoadAt of_tension(double threshold, double capacitance, const Vector& varying, const SphereTransform& fine,
                  const Vector& potential, const Vector& tension) {
  Vector sum = fine.synthesize(tension);
  if (potential.size() > 0) {
    const Vector square = Vector(fine.synthesize(potential)).cwiseAbs2();
    sum += varying.size() > 0 ? Vector(0.5 * Vector(fine.synthesize(varying)).cwiseProduct(square))
                              : Vector(0.5 * capacitance * square);
  }
  const Vector coefficients = fine.analyze(sum);
  const Top top = top_of(fine.grid(), fine.synthesize_hessian(coefficients), 0, coefficients, 1.0);
  return {top.value / threshold, std::numeric_limits<double>::quiet_NaN(), top.point};
}

/// Share of the step at which the load passes 1, from below 1 at its start to at least 1 at its end.
double crossing_share(const PorationLoad& from, const PorationLoad& to, double dt) {
  const double missing = 1.0 - from.load, exceeds = to.load - 1.0;
  const double straight = missing / (missing + exceeds);
  if (!std::isfinite(from.rate) || !std::isfinite(to.rate)) return straight;
  const auto load_at = [&](double s) {
    const double r = 1.0 - s;
    return r * r * ((1.0 + 2.0 * s) * from.load + s * dt * from.rate) +
           s * s * ((1.0 + 2.0 * r) * to.load - r * dt * to.rate);
  };
  // The cubic interpolates both ends, so bisection finds a crossing.
  double low = 0.0, high = 1.0;
  for (int i = 0; i < std::numeric_limits<double>::digits; ++i) {
    const double middle = 0.5 * (low + high);
    (load_at(middle) < 1.0 ? low : high) = middle;
  }
  return high;
}

std::optional<FirstCrossing> crossing_of(const PorationLoad* before, double time_before, const PorationLoad& arrival,
                                         const PorationLoad& after, double time) {
  if (before != nullptr && before->load < 1.0 && arrival.load >= 1.0) {
    const double dt = time - time_before;
    const double share = crossing_share(*before, arrival, dt);
    return FirstCrossing{time_before + share * dt, share < 0.5 ? before->place : arrival.place};
  }
  if (after.load >= 1.0) return FirstCrossing{time, after.place};
  return std::nullopt;
}

}  // namespace

PorationLoad poration_load(const PorationCriterion& criterion, double capacitance, const SphereTransform& fine,
                           const VesicleState& vesicle, const VesicleSolution& solution, const VesicleFields& fields) {
  const Vector& potential = transmembrane_potential(vesicle, fields);
  LoadAt most;
  if (criterion.potential && potential.size() > 0) {
    // The rate of the state is that of a charge if V_m follows from free charges.
    const bool known = fields.potential.size() == 0;
    most =
        of_potential(*criterion.potential, fine, potential, known ? solution.rate.transmembrane_potential : Vector());
  }
  if (criterion.tension && fields.tension.size() > 0) {
    const LoadAt of_layer =
        of_tension(*criterion.tension, capacitance, vesicle.material.capacitance, fine, potential, fields.tension);
    if (of_layer.load > most.load) most = of_layer;
  }
  const Matrix place = evaluate_harmonics(vesicle.position, Vector{{most.point.theta}}, Vector{{most.point.phi}});
  return {most.load, most.rate, place.row(0).transpose()};
}

void note_first_crossings(const Evaluation* before, double time_before, const Evaluation& arrival,
                          const Evaluation& after, State& state) {
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    std::optional<FirstCrossing>& crossing = state.vesicles[a].crossing;
    if (!crossing || std::isfinite(crossing->time)) continue;
    const auto found =
        crossing_of(before != nullptr ? &before->diagnostics.vesicles[a].load : nullptr, time_before,
                    arrival.diagnostics.vesicles[a].load, after.diagnostics.vesicles[a].load, state.time);
    if (found) crossing = found;
  }
}

void report_crossings(const State& state, double time, Evaluation& evaluation) {
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const std::optional<FirstCrossing>& crossing = state.vesicles[a].crossing;
    if (!crossing || crossing->time > time) continue;
    VesicleDiagnostics& d = evaluation.diagnostics.vesicles[a];
    d.poration_time = crossing->time;
    std::tie(d.poration_x, d.poration_y, d.poration_z) = components(crossing->place);
  }
}

}  // namespace vehd

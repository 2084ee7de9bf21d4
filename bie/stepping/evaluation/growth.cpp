#include "bie/stepping/evaluation/growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/wrinkling.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

double radius_of(const VesicleState& vesicle) { return std::sqrt(vesicle.reference_area / (4.0 * std::numbers::pi)); }

/// λ, 0 where a sphere leaves it open.
double mean_tension(const SolvedFields& solved, std::size_t a) {
  const VesicleSolution& solution = solved.vesicles[a];
  const Vector& tension = solved.fields.vesicles[a].tension;
  if (tension.size() == 0 || solution.is_sphere) return 0.0;
  const Vector& weights = solution.membrane->surface.quadrature;
  return weights.dot(Vector(solution.membrane->fine.synthesize(tension))) / weights.sum();
}

bool is_compressed(const SolvedFields& solved) {
  for (std::size_t a = 0; a < solved.vesicles.size(); ++a) {
    if (mean_tension(solved, a) < 0.0) return true;
  }
  return false;
}

/// Largest velocity along the normal but for that of degree 0, which changes nothing of a membrane.
double normal_speed(const SphereTransform& fine, const Matrix& position, const Matrix& velocity) {
  Matrix moving = velocity;
  moving.row(0).setZero();
  const SphereDerivatives there = fine.synthesize_gradient(position);
  const Matrix moved = fine.synthesize(moving);
  double largest = 0.0;
  for (Index i = 0; i < moved.rows(); ++i) {
    const Vector3 across = Vector3(there.d1.row(i)).cross(Vector3(there.d2.row(i)));
    largest = std::max(largest, std::abs(across.dot(Vector3(moved.row(i)))) / across.norm());
  }
  return largest;
}

/// In which V_m changes by half of what it is, and its stress, which goes with the square, by all.
double charging_time(const VesicleState& vesicle, const VesicleSolution& solution) {
  const double rate = solution.potential_rate.size() > 0 ? solution.potential_rate.norm() : 0.0;
  return rate > 0.0 ? 0.5 * vesicle.transmembrane_potential.norm() / rate : endless;
}

/// A tension for a time.
struct Stage {
  double tension = 0.0;  // λ, the mean
  double time = 0.0;
};

/// What there is for `time_left` or until the shape is another one.
Stage stage_of(const MembraneSpace& space, const VesicleState& vesicle, const SolvedFields& solved, std::size_t a,
               double time_left) {
  const double radius = radius_of(vesicle);
  const double speed = normal_speed(space.fine_transform(), vesicle.position, solved.fields.vesicles[a].velocity);
  return {mean_tension(solved, a), speed * time_left > radius ? radius / speed : time_left};
}

/// A compression that weakens steadily does what half of it would until it is gone.
Stage weakened(Stage stage, const Outlook& outlook, std::size_t a) {
  if (!outlook.soon) return stage;
  const double change = mean_tension(*outlook.soon, a) - stage.tension;
  if (stage.tension < 0.0 && change > 0.0) {
    stage.time = std::min(stage.time, -0.5 * stage.tension * outlook.delay / change);
  }
  return stage;
}

/// Σ σ_n T of stages one after the other, of the degrees from `lowest` to that of the vesicle the largest of each: a
/// shape hands errors on from degree to degree, and those of a low one, which outlast a tension, are in the high ones
/// when these begin to grow. 0 where all die away.
double exponent_of(const FlowParameters& parameters, const VesicleState& vesicle, const std::vector<Stage>& stages,
                   int lowest) {
  const double radius = radius_of(vesicle);
  const int first = std::max(2, lowest), highest = order_of(vesicle.position.rows());
  double exponent = 0.0;
  for (const Stage& stage : stages) {
    double fastest = first > highest ? 0.0 : -endless;
    for (int degree = first; degree <= highest; ++degree) {
      const double rate = disturbance_rate(parameters, stage.tension, radius, degree);
      fastest = std::max(fastest, rate != 0.0 ? rate * stage.time : 0.0);
    }
    exponent += fastest;
  }
  return std::max(exponent, 0.0);
}

/// Exponents of what may happen; `sure` are those that the change of V_m and field does not speak against.
struct Exponents {
  double possible = 0.0, sure = 0.0;

  [[nodiscard]] double growth(double most) const {
    return std::exp(std::max(std::min(possible, std::log(thresholds::unsure_growth)), std::min(sure, std::log(most))));
  }
};

/// A state with what is known of it and of what comes.
struct Present {
  const Model& model;
  const Discretisation& discretisation;
  const State& state;
  const SolvedFields& solved;
  const Outlook& outlook;

  /// Of the degrees of a vesicle from `lowest` on.
  [[nodiscard]] Exponents exponents(std::size_t a, int lowest) const {
    const VesicleState& vesicle = state.vesicles[a];
    const FlowParameters parameters = flow_parameters(model, model.vesicles[a]);
    const MembraneSpace& space = discretisation.vesicle(a);
    const Stage now = stage_of(space, vesicle, solved, a, outlook.jump.value_or(outlook.until) - state.time);
    const Stage surely = weakened(now, outlook, a);
    Exponents result{exponent_of(parameters, vesicle, {now}, lowest),
                     exponent_of(parameters, vesicle, {surely}, lowest)};
    if (!outlook.after_jump) return result;
    const SolvedFields& after = *outlook.after_jump;
    Stage later = stage_of(space, vesicle, after, a, outlook.until - *outlook.jump);
    later.time = std::min(later.time, charging_time(vesicle, after.vesicles[a]));
    result.sure = std::max(result.sure, exponent_of(parameters, vesicle, {surely, later}, lowest));
    return result;
  }
  /// Of the vesicle where it is largest, at most `most`.
  /// @param lowest  of the degrees that count, where there are those up to p
  template <typename Lowest>
  [[nodiscard]] double growth(double most, Lowest lowest) const {
    double largest = 1.0;
    for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
      largest = std::max(largest, exponents(a, lowest(discretisation.vesicle(a).order())).growth(most));
    }
    return largest;
  }
};

std::optional<SolvedFields> solved_if_possible(const Model& model, const Discretisation& discretisation,
                                               const State& state, const SolvedFields& same_shapes, Limit limit,
                                               Instruments& instruments) {
  try {
    return solve_fields(model, discretisation, state, instruments, &same_shapes, limit, Shapes::of_previous);
  } catch (const ConvergenceError&) {
    return {};
  }
}

/// Straight on from where it is.
State in_a_moment(State state, const SolvedFields& solved, double delay) {
  state.time += delay;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    VesicleState& vesicle = state.vesicles[a];
    const VesicleSolution& solution = solved.vesicles[a];
    if (solution.potential_rate.size() > 0) vesicle.transmembrane_potential += delay * solution.potential_rate;
    if (solution.free_charge_rate.size() > 0) vesicle.free_charge += delay * solution.free_charge_rate;
  }
  return state;
}

}  // namespace

Outlook look_ahead(const Model& model, const Discretisation& discretisation, const State& state,
                   const SolvedFields& solved, double until, double delay, Instruments& instruments) {
  Outlook outlook{until};
  if (!model.mobile || until <= state.time) return outlook;
  const std::optional<double> jump = next_discontinuity(model, state.time);
  outlook.delay = jump ? std::min(delay, *jump - state.time) : delay;
  const bool charges = model.electric && !is_averaged(model) && !solved.electric_inactive;
  if (charges && is_compressed(solved)) {
    outlook.soon = solved_if_possible(model, discretisation, in_a_moment(state, solved, outlook.delay), solved,
                                      Limit::before, instruments);
  }
  if (jump && *jump < until) {
    outlook.jump = jump;
    State there = state;
    there.time = *jump;
    outlook.after_jump = solved_if_possible(model, discretisation, there, solved, Limit::after, instruments);
  }
  return outlook;
}

ErrorGrowth expected_growth(const Model& model, const Discretisation& discretisation, const State& state,
                            const SolvedFields& solved, const Outlook& outlook) {
  if (!model.mobile || outlook.until <= state.time) return {};
  const Present present{model, discretisation, state, solved, outlook};
  return {present.growth(thresholds::most_growth_of_steps, [](int) { return 2; }),
          present.growth(thresholds::most_growth_of_degrees,
                         [](int order) { return order / thresholds::degrees_that_feel_the_cut; })};
}

double memory_of_shapes(const Model& model, const State& state, const SolvedFields& solved, double until) {
  if (!model.mobile || until <= state.time) return 0.0;
  const double time_left = until - state.time;
  double longest = 0.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const Matrix& velocity = solved.fields.vesicles[a].velocity;
    const double speed = velocity.bottomRows(velocity.rows() - 1).norm() / std::sqrt(4.0 * std::numbers::pi);
    const double radius = radius_of(state.vesicles[a]);
    longest = std::max(longest, speed * time_left > radius ? radius / speed : time_left);
  }
  return longest;
}

}  // namespace vehd

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "bie/stepping/evolution.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/thread_count.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kHighestOrder = 40;

EvolutionSetup setup_of(const Model& model, const Matrix& position, double tolerance, double end_time) {
  State start = at_rest(position);
  EvolutionSetup setup;
  setup.model = model;
  setup.settings.order = kHighestOrder;
  setup.settings.time_order = 4;
  setup.symmetry = find_symmetry(model, start);
  setup.control = {end_time, 1e-9 * end_time, tolerance};
  return setup;
}

/// Setup with steps of fixed size dt at the degree of the position.
EvolutionSetup fixed_setup(const Model& model, const Matrix& position, double dt) {
  EvolutionSetup setup = setup_of(model, position, 0.0, 1.0);
  setup.settings.order = order_of(position.rows());
  setup.control = fixed_steps(dt);
  return setup;
}

/// r = 1 + a Y_3^0 + b Y_4^0.
Matrix rippled(double a, double b) {
  const SphereTransform transform(kHighestOrder, make_grid(kHighestOrder));
  Matrix harmonics = Matrix::Zero(n_coefficients(kHighestOrder), 1);
  harmonics(coefficient_index(3, 0), 0) = a;
  harmonics(coefficient_index(4, 0), 0) = b;
  const Vector radius = Vector(transform.synthesize(harmonics)).array() + 1.0;
  return transform.analyze(radius.asDiagonal() * grid_directions(transform.grid()));
}

struct Result {
  VesicleDiagnostics diagnostics;
  int lowest_order, highest_order, n_steps;
};

Result run_to(const Model& model, const Matrix& position, double tolerance, double end_time) {
  Instruments instruments;
  Evolution evolution(setup_of(model, position, tolerance, end_time), {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  Result result{{}, evolution.order(0), evolution.order(0), 0};
  while (evolution.state().time < end_time) {
    evolution.step({{}, end_time});
    result.lowest_order = std::min(result.lowest_order, evolution.order(0));
    result.highest_order = std::max(result.highest_order, evolution.order(0));
    ++result.n_steps;
  }
  BOOST_TEST(evolution.state().time == end_time);
  result.diagnostics = evolution.evaluation().diagnostics.vesicles[0];
  return result;
}

double difference(const VesicleDiagnostics& a, const VesicleDiagnostics& b) {
  double largest = 0.0;
  for (const auto member :
       {&VesicleDiagnostics::extent_x, &VesicleDiagnostics::extent_z, &VesicleDiagnostics::bending_energy_scaled,
        &VesicleDiagnostics::tension_integral, &VesicleDiagnostics::Vm_max, &VesicleDiagnostics::Vm_north}) {
    largest = std::max(largest, std::abs(a.*member / (b.*member) - 1.0));
  }
  return largest;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(adaptive_evolution)

BOOST_AUTO_TEST_CASE(steps_are_the_same_bit_for_bit_however_many_threads_have_nodes_of_their_own) {
  struct Steps {
    State state;
    int evaluations = 0, iterations_flow = 0, iterations_electric = 0;
  };
  // Without any symmetry, so that a dependence on the number of threads would show in any sum.
  const Matrix position = asymmetric_shape(10);
  const auto steps_with = [&](int threads) {
    const ThreadCount count(threads);
    Instruments instruments;
    Evolution evolution(setup_of(field_model(), position, 1e-2, 1.0), {StartMembrane{position}}, instruments);
    evolution.evaluate_start();
    // At higher degrees threads share each node.
    BOOST_TEST_REQUIRE(evolution.order(0) <= 16);
    Steps steps;
    for (int i = 0; i < 3; ++i) {
      const StepAttempt step = evolution.step({{}, 1.0});
      steps.evaluations += step.evaluations;
      steps.iterations_flow += step.iterations_flow;
      steps.iterations_electric += step.iterations_electric;
    }
    steps.state = evolution.state();
    return steps;
  };
  const Steps alone = steps_with(1);
  for (const int threads : {2, 3}) {
    const Steps shared = steps_with(threads);
    const VesicleState &a = alone.state.vesicles[0], &b = shared.state.vesicles[0];
    BOOST_TEST(shared.state.time == alone.state.time);
    BOOST_TEST(shared.evaluations == alone.evaluations);
    BOOST_TEST(shared.iterations_flow == alone.iterations_flow);
    BOOST_TEST(shared.iterations_electric == alone.iterations_electric);
    BOOST_REQUIRE(b.position.rows() == a.position.rows());
    BOOST_TEST((b.position.array() == a.position.array()).all());
    BOOST_TEST((b.tension.array() == a.tension.array()).all());
    BOOST_TEST((b.transmembrane_potential.array() == a.transmembrane_potential.array()).all());
  }
}

BOOST_AUTO_TEST_CASE(a_vesicle_in_a_field_is_accurate_to_the_tolerance) {
  constexpr double kEnd = 6.0;
  const Matrix position = prolate(kHighestOrder);
  const VesicleDiagnostics reference = run_to(field_model(), position, 1e-6, kEnd).diagnostics;
  int steps_before = 0;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const Result result = run_to(field_model(), position, tolerance, kEnd);
    const double error = difference(result.diagnostics, reference);
    BOOST_TEST_MESSAGE("tolerance " << tolerance << ": error " << error << ", " << result.n_steps << " steps, degrees "
                                    << result.lowest_order << " to " << result.highest_order);
    BOOST_TEST(error < 3.0 * tolerance);
    BOOST_TEST(result.n_steps > steps_before);
    BOOST_TEST(result.highest_order < kHighestOrder);
    steps_before = result.n_steps;
  }
}

BOOST_AUTO_TEST_CASE(degree_follows_the_spectrum_up_and_down) {
  // The prolate starts smooth; the field makes it change fast, and at the end it is smooth again.
  const Result result = run_to(field_model(), prolate(kHighestOrder), 1e-3, 70.0);
  BOOST_TEST(result.lowest_order < 16);
  BOOST_TEST(result.highest_order > 20);
}

BOOST_AUTO_TEST_CASE(degree_rises_where_the_grid_cannot_be_moved_without_it) {
  // Its spectrum ends below the lowest degree, so that the shape seems resolved. It is nearly a sphere: restoring the
  // area on another grid of that degree needs a much larger change of the shape. A start has the degree of its tension.
  const EvolutionSetup setup = setup_of(relaxation_model(0.1), rippled(0.04, 0.05), 1e-6, 1e-2);
  Instruments instruments;
  Evolution start(setup, {StartMembrane{rippled(0.04, 0.05)}}, instruments);
  start.evaluate_start();
  BOOST_TEST(start.order(0) > lowest_adaptive_order);
  State low = start.state();
  low.vesicles[0] = resized(std::move(low.vesicles[0]), lowest_adaptive_order);
  Evolution evolution(setup, low, instruments);
  evolution.evaluate_start();
  BOOST_TEST(evolution.order(0) == lowest_adaptive_order);
  evolution.step({{}, 1e-2});
  BOOST_TEST(evolution.order(0) > lowest_adaptive_order);
}

BOOST_AUTO_TEST_CASE(degree_of_the_start_resolves_its_tension) {
  // At degree 8, although the ellipsoid has degree 1, the tension has an error of 0.008.
  const auto tension_at_start = [](double tolerance) {
    const Matrix position = ellipsoid(kHighestOrder, {1.0, 1.0, 1.9621762549176331});
    Instruments instruments;
    Evolution evolution(setup_of(relaxation_model(1.0), position, tolerance, 1.0), {StartMembrane{position}},
                        instruments);
    evolution.evaluate_start();
    return evolution.evaluation().diagnostics.vesicles[0].tension_integral;
  };
  const double exact = tension_at_start(1e-8);
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    BOOST_TEST(std::abs(tension_at_start(tolerance) / exact - 1.0) < tolerance);
  }
}

BOOST_AUTO_TEST_CASE(degree_of_the_start_resolves_its_charge) {
  // Shape and V_m at the start have no degree above 1, but the charge on the prolate has all degrees.
  const auto charge_at_start = [](double tolerance) {
    const Matrix position = prolate(kHighestOrder);
    Instruments instruments;
    Evolution evolution(setup_of(field_model(), position, tolerance, 1.0), {StartMembrane{position}}, instruments);
    evolution.evaluate_start();
    return evolution.evaluation().diagnostics.vesicles[0].q_north;
  };
  const double exact = charge_at_start(1e-8);
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    BOOST_TEST(std::abs(charge_at_start(tolerance) / exact - 1.0) < tolerance);
  }
}

BOOST_AUTO_TEST_CASE(step_of_a_fixed_size_never_changes_the_degree) {
  const Matrix position = prolate(12);
  Instruments instruments;
  Evolution evolution(fixed_setup(field_model(), position, 0.25), {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  for (int i = 0; i < 4; ++i) BOOST_TEST(evolution.step({{}, 1.0}).dt == 0.25);
  BOOST_TEST(evolution.order(0) == 12);
  BOOST_TEST(evolution.state().time == 1.0);
}

BOOST_AUTO_TEST_CASE(state_of_an_evolution_continues_to_the_same_bits) {
  const Matrix position = prolate(kHighestOrder);
  const EvolutionSetup setup = setup_of(field_model(), position, 1e-2, 5.0);
  Instruments instruments;
  Evolution whole(setup, {StartMembrane{position}}, instruments);
  whole.evaluate_start();
  for (int i = 0; i < 4; ++i) whole.step({{}, 5.0});
  Evolution resumed(setup, whole.state(), instruments);
  resumed.evaluate_start();
  for (int i = 0; i < 3; ++i) {
    whole.step({{}, 5.0});
    resumed.step({{}, 5.0});
  }
  BOOST_TEST(whole.state().time == resumed.state().time);
  BOOST_TEST((whole.state().vesicles[0].position - resumed.state().vesicles[0].position).isZero(0.0));
}

BOOST_AUTO_TEST_CASE(tank_treading_in_long_steps_leaves_high_degrees_alone) {
  // Undoing the sliding of a step must not feed modes that slide past their own wavelength.
  const Matrix position = ellipsoid(20, {2.0, 1.0, 1.0});
  EvolutionSetup setup = fixed_setup(shear_model(), position, 0.25);
  setup.settings.time_order = 1;
  Instruments instruments;
  Evolution evolution(setup, {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  for (int i = 0; i < 12; ++i) BOOST_TEST(evolution.step({{}, 3.0}).rejected == 0);
  BOOST_TEST(evolution.truncation() < 3e-6);
}

BOOST_AUTO_TEST_CASE(remainder_of_a_geometric_spectrum_is_its_sum) {
  constexpr double kDecay = 0.5;
  State state;
  state.vesicles.emplace_back();
  state.vesicles[0].reference_area = 4.0 * std::acos(-1.0);
  const int order = 12;
  state.vesicles[0].position = Matrix::Zero(n_coefficients(order), 3);
  const auto bound = [&](int n) { return std::pow(kDecay, n); };
  for (int n = 1; n <= order; ++n) {
    state.vesicles[0].position(coefficient_index(n, 0), 0) =
        bound(n) / std::sqrt((2.0 * n + 1.0) / state.vesicles[0].reference_area);
  }
  const Resolution resolution(Model{}, state.vesicles[0]);
  const double beyond = bound(order) * kDecay / (1.0 - kDecay);
  BOOST_TEST(resolution.remainder() > 0.9 * beyond);
  BOOST_TEST(resolution.remainder() < 3.0 * beyond);
  const int enough = resolution.order_for(1e-6, 4, 64);
  BOOST_TEST(enough >= 20);
  BOOST_TEST(enough <= 24);
  BOOST_TEST(resolution.order_for(1e-2, 4, 64) <= 8);
  BOOST_TEST(resolution.order_for(1e-12, 4, 32) == 32);
}

BOOST_AUTO_TEST_SUITE_END()

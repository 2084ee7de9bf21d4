#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/physics/effects/poration.hpp"
#include "bie/stepping/evolution.hpp"
#include "tests/stepping/porating_sphere.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(poration_steps)

using namespace vehd;
using namespace vehd::testing;

namespace {

/// A reaction and how long it is followed: pores from their creation until their conductance discharges the membrane, a
/// porosity as long as it rises everywhere, since its second derivative jumps where it begins to fall.
struct Case {
  std::shared_ptr<const PorationReaction> reaction;
  double end;
  double accuracy = 1e-8;
};

std::array<Case, 2> smooth_cases() {
  return {Case{std::make_shared<PoreDensity>(PoreParameters{2.0, 0.5, 1.0, 2.46, 0.3}), 0.4},
          Case{std::make_shared<MembranePorosity>(PorosityParameters{8.0, 0.6, 4.0, 0.2, 50.0}), 0.08}};
}

Model frozen_model(std::shared_ptr<const PorationReaction> reaction, double field, double capacitance,
                   double conductance) {
  Model model;
  set_electric(model, {{0.0, 0.0, field}, 1.0, 2.0, 1.0}, {capacitance, conductance});
  model.mobile = false;
  model.vesicles[0].reaction = std::move(reaction);
  return model;
}

constexpr double start_potential = 0.75;
const double uniform = std::sqrt(4.0 * std::numbers::pi);

/// V and s at the end for a membrane that discharges only through itself, both uniform: one point.
std::array<double, 2> at_one_point(const Model& model, int time_order, double end, int n_steps) {
  NumericalSettings settings = solved_to_rounding(4);
  settings.time_order = time_order;
  const Discretisation discretisation(settings, find_symmetry(model, at_rest(sphere(4))));
  State state = start(model, discretisation, sphere(4), end / n_steps);
  state.vesicles[0].transmembrane_potential[0] = start_potential * uniform;
  state = run(model, discretisation, state, end / n_steps, n_steps);
  return {state.vesicles[0].transmembrane_potential[0] / uniform, state.vesicles[0].poration[0] / uniform};
}

/// The same values by the classical Runge–Kutta rule.
std::array<double, 2> independent_point(const PorationReaction& reaction, double capacitance, double conductance,
                                        double end, int n_steps) {
  Vector y{{start_potential, reaction.start()}};
  const auto rate = [&](const Vector& of) {
    const double current = (conductance + reaction.conductance(of[1]).value) * of[0];
    return Vector{{-current / capacitance, reaction.rate(of[1], of[0])}};
  };
  for (int i = 0; i < n_steps; ++i) y = runge_kutta_step(y, end / n_steps, rate);
  return {y[0], y[1]};
}

double error_at_one_point(const Case& of, int time_order, int n_steps) {
  constexpr double kCapacitance = 0.5, kConductance = 0.3;
  const auto exact = independent_point(*of.reaction, kCapacitance, kConductance, of.end, 4000);
  const auto found =
      at_one_point(frozen_model(of.reaction, 0.0, kCapacitance, kConductance), time_order, of.end, n_steps);
  return std::max(std::abs(found[0] - exact[0]), std::abs(found[1] - exact[1]));
}

}  // namespace

BOOST_AUTO_TEST_CASE(one_point_is_followed_at_every_order) {
  for (const Case& of : smooth_cases()) {
    for (int order = 1; order <= 5; ++order) {
      const int n_steps = order < 3 ? 64 : 16;
      const double coarse = error_at_one_point(of, order, n_steps);
      const double fine = error_at_one_point(of, order, 2 * n_steps);
      BOOST_TEST_MESSAGE(order << ": " << coarse << " " << fine);
      BOOST_TEST(std::log2(coarse / fine) > order - 0.4,
                 of.reaction->description().adds << " " << order << ": " << coarse << " " << fine);
    }
  }
}

BOOST_AUTO_TEST_CASE(one_point_is_that_of_an_independent_integrator_to_eight_digits) {
  for (const Case& of : smooth_cases()) {
    const double error = error_at_one_point(of, 5, 64);
    BOOST_TEST(error < 1e-8, of.reaction->description().adds << ": " << error);
  }
}

BOOST_AUTO_TEST_CASE(stiff_creation_and_a_porosity_that_falls_again_hold_a_tolerance) {
  // Pores form within a thousandth of the run, and X stops rising half-way.
  const std::array<Case, 2> stiff{
      Case{std::make_shared<PoreDensity>(PoreParameters{1e-3, 0.2, 1.0, 2.46, 1e-3}), 0.4, 2e-5},
      // A jump within a step escapes its error estimate.
      Case{std::make_shared<MembranePorosity>(PorosityParameters{8.0, 0.6, 4.0, 0.2, 50.0}), 0.4, 1e-4}};
  for (const Case& of : stiff) {
    const auto exact = independent_point(*of.reaction, 0.5, 0.3, of.end, 20000);
    EvolutionSetup setup;
    setup.model = frozen_model(of.reaction, 0.0, 0.5, 0.3);
    // Without charge, since its relative error would be one of rounding.
    setup.model.electric->conductivity = setup.model.vesicles[0].inside.conductivity;
    setup.settings = solved_to_rounding(4);
    setup.settings.time_order = 4;
    setup.symmetry = find_symmetry(setup.model, at_rest(sphere(4)));
    setup.control = fixed_steps(0.1);
    setup.control.tolerance = 1e-5;
    setup.control.smallest = 1e-12;
    StartMembrane membrane{sphere(4)};
    membrane.potential.given = start_potential * uniform * Vector::Unit(25, 0);
    Instruments instruments;
    Evolution evolution(setup, {membrane}, instruments);
    evolution.evaluate_start();
    while (evolution.state().time < of.end) evolution.step({{}, of.end});
    const VesicleState& end = evolution.state().vesicles[0];
    BOOST_TEST_MESSAGE(evolution.state().step << " steps");
    BOOST_TEST(std::abs(end.transmembrane_potential[0] / uniform - exact[0]) < of.accuracy);
    BOOST_TEST(std::abs(end.poration[0] / uniform - exact[1]) < of.accuracy);
  }
}

BOOST_AUTO_TEST_CASE(a_sphere_porates_as_an_independent_integrator_says) {
  constexpr double kField = 1.0, kEnd = 1.2, kCapacitance = 0.5, kConductance = 0.01;
  constexpr int kOrder = 24;
  for (const auto& reaction : {std::shared_ptr<const PorationReaction>(
                                   std::make_shared<PoreDensity>(PoreParameters{1e-6, 0.2, 1.0, 2.46, 1e-5})),
                               std::shared_ptr<const PorationReaction>(std::make_shared<MembranePorosity>(
                                   PorosityParameters{20.0, 0.9, 6.0, 0.05, 50.0}))}) {
    const Model model = frozen_model(reaction, kField, kCapacitance, kConductance);
    const Discretisation discretisation = symmetric_discretisation(model, sphere(kOrder), 3);
    State state = start(model, discretisation, sphere(kOrder), kEnd / 48);
    PoratingSphere independent({kField, 1.0, 2.0, kCapacitance, kConductance}, *reaction, 48);
    for (int part = 0; part < 3; ++part) {
      state = run(model, discretisation, state, kEnd / 48, 16);
      independent.advance(kEnd / 3.0, 2000);
      const VesicleDiagnostics d = evaluated(model, discretisation, state).diagnostics;
      const double expected = independent.potential_at_pole();
      BOOST_TEST(std::abs(d.Vm_pole_plus / expected - 1.0) < 0.01,
                 reaction->description().adds << " " << part << ": " << d.Vm_pole_plus << " " << expected);
      BOOST_TEST(std::abs(d.poration_max / reaction->measure(independent.state_at_pole()) - 1.0) < 0.1,
                 part << ": " << d.poration_max << " " << reaction->measure(independent.state_at_pole()));
    }
    // Far from the potential of an intact membrane, 1.5 E a (1 − exp(−t/τ)).
    BOOST_TEST(independent.potential_at_pole() < 1.25);
  }
}

BOOST_AUTO_TEST_CASE(pores_close_within_their_time) {
  // The closing time is N_0/α = 1.5; steps of a tenth of it, without a field.
  const auto reaction = std::make_shared<PoreDensity>(PoreParameters{1e9, 0.258, 1.5e9, 2.46, 0.0});
  const Model model = frozen_model(reaction, 0.0, 1.0, 0.0);
  const Discretisation discretisation = symmetric_discretisation(model, sphere(4), 3);
  State state = start(model, discretisation, sphere(4), 0.15);
  state.vesicles[0].poration[0] = std::log(1e4) * uniform;
  const auto beyond_rest = [&] {
    return evaluated(model, discretisation, state).diagnostics.poration_mean / 1.5e9 - 1.0;
  };
  const double before = beyond_rest();
  state = run(model, discretisation, state, 0.15, 20);
  const double time = 3.0 / std::log(before / beyond_rest());
  BOOST_TEST(std::abs(time - 1.5) < 0.0015, time);
}

BOOST_AUTO_TEST_CASE(pores_ride_with_the_membrane) {
  // A porosity that hardly changes by itself, in a shear flow that turns the membrane by half a radian.
  Model model = shear_model();
  set_electric(model, {{0.0, 0.0, 0.0}, 1.0, 2.0, 1.0}, {1.0, 0.0});
  model.vesicles[0].reaction = std::make_shared<MembranePorosity>(PorosityParameters{1.0, 1.0, 10.0, 1e9, 1e10});
  const Matrix position = ellipsoid(10, {1.0, 1.0, 1.2});
  const Discretisation discretisation = symmetric_discretisation(model, position, 2);
  State state = start(model, discretisation, position, 0.05);
  state.vesicles[0].poration[0] = 0.5 * uniform;
  // Harmonics with the symmetries of the flow.
  state.vesicles[0].poration += 0.1 * harmonic(10, 2, 1) + 0.1 * harmonic(10, 2, 2);
  const VesicleDiagnostics before = evaluated(model, discretisation, state).diagnostics;
  const Vector at_start = state.vesicles[0].poration;
  state = run(model, discretisation, state, 0.05, 20);
  const VesicleDiagnostics after = evaluated(model, discretisation, state).diagnostics;
  BOOST_TEST(max_difference(state.vesicles[0].poration, at_start) > 0.03);
  BOOST_TEST(std::abs(after.poration_max - before.poration_max) < 1e-3);
  BOOST_TEST(std::abs(after.poration_mean - before.poration_mean) < 1e-5);
}

BOOST_AUTO_TEST_SUITE_END()

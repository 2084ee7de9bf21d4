#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "bie/stepping/evolution.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(alternating_charge)

namespace {

constexpr double kFrequency = 0.5;
constexpr double kEnd = 6.0;
/// Charging time C R (1/σ_i + 1/(2σ_e)) of the sphere below.
constexpr double kTime = 1.25;

Model sphere_in_alternating_field() {
  Model model;
  model.mobile = false;
  set_electric(model, {{0.0, 0.0, 1.0}, 1.0, 2.0, 1.0}, {1.0, 0.0});
  model.electric->waveform = Waveform::alternating(1.0, kFrequency, 0.0);
  return model;
}

/// V_m at the pole charged by 3/2 E cos(ωt), after the initial transient has decayed.
double settled(double time) {
  constexpr std::complex<double> rate(0.0, 2.0 * std::numbers::pi * kFrequency);
  return std::real(1.5 * std::exp(rate * time) / (1.0 + kTime * rate));
}

/// V_m at the pole, given its value at the time `from`.
double exact(double potential, double from, double time) {
  return settled(time) + (potential - settled(from)) * std::exp(-(time - from) / kTime);
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_step_and_no_moment_leaves_more_than_its_share_of_the_tolerance) {
  // The limit of the sweeps has a larger error than the sweeps leave: the rule does not resolve the cosine.
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    EvolutionSetup setup;
    setup.model = sphere_in_alternating_field();
    setup.settings = tight_settings(tolerance < 1e-4 ? highest_time_order : 4);
    setup.settings.order = 8;
    setup.symmetry = find_symmetry(setup.model, at_rest(sphere(8)));
    setup.control = {kEnd, 1e-9 * kEnd, tolerance};
    Instruments instruments;
    Evolution evolution(setup, {StartMembrane{sphere(8)}}, instruments);
    evolution.evaluate_start();
    const auto north = [](const Evaluation& evaluation) { return evaluation.diagnostics.vesicles[0].Vm_north; };
    const auto share = [&](double potential, double from, double start, double time) {
      const double expected = exact(start, from, time);
      return std::abs(potential - expected) / (tolerance * std::max(std::abs(expected), 0.1));
    };
    double of_steps = 0.0, of_moments = 0.0;
    int n_moments = 0;
    while (evolution.state().time < kEnd) {
      const double from = evolution.state().time, start = north(evolution.evaluation());
      evolution.step({{.every = 0.37}, kEnd});
      of_steps = std::max(of_steps, share(north(evolution.evaluation()), from, start, evolution.state().time));
      for (const Evolution::DenseOutput& moment : evolution.dense_output()) {
        of_moments = std::max(of_moments, share(north(moment.evaluation), from, start, moment.state.time));
        ++n_moments;
      }
    }
    BOOST_TEST_MESSAGE(tolerance << ": " << evolution.state().step << " steps, " << of_steps << " at their ends, "
                                 << of_moments << " at " << n_moments << " moments");
    BOOST_TEST(n_moments > 10);
    BOOST_TEST(of_steps < 0.5);
    BOOST_TEST(of_moments < 1.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()

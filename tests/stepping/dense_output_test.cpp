#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "bie/stepping/evolution.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/thread_count.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(dense_output)

namespace {

constexpr double kEnd = 3.0;
constexpr double kTolerance = 1e-3;
constexpr double kFrom = 1.0;
constexpr double kEvery = 0.07;

EvolutionSetup setup_of(const Model& model, const Matrix& position, int time_order) {
  EvolutionSetup setup;
  setup.model = model;
  setup.settings.order = order_of(position.rows());
  setup.settings.time_order = time_order;
  setup.symmetry = find_symmetry(model, at_rest(position));
  setup.control = {kEnd, 1e-9 * kEnd, kTolerance};
  return setup;
}

struct Run {
  std::vector<double> step_times;
  std::vector<Evolution::DenseOutput> moments;
  State end;
};

Run rest_of(Evolution& evolution, const SnapshotTimes& snapshots) {
  Run run;
  while (evolution.state().time < kEnd) {
    evolution.step({snapshots, kEnd});
    run.step_times.push_back(evolution.state().time);
    run.moments.insert(run.moments.end(), evolution.dense_output().begin(), evolution.dense_output().end());
  }
  run.end = evolution.state();
  return run;
}

Run run_of(const EvolutionSetup& setup, const Matrix& position, const SnapshotTimes& snapshots) {
  Instruments instruments;
  Evolution evolution(setup, {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  return rest_of(evolution, snapshots);
}

Matrix start_shape() { return prolate(20); }

void require_same_bits(const std::vector<Evolution::DenseOutput>& found,
                       const std::vector<Evolution::DenseOutput>& expected) {
  BOOST_TEST_REQUIRE(expected.size() > 10U);
  BOOST_TEST_REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const VesicleState& x = expected[i].state.vesicles[0];
    const VesicleState& y = found[i].state.vesicles[0];
    BOOST_TEST((x.position - y.position).isZero(0.0));
    BOOST_TEST((x.transmembrane_potential - y.transmembrane_potential).isZero(0.0));
    BOOST_TEST(expected[i].evaluation.diagnostics.vesicles[0].tension_integral ==
               found[i].evaluation.diagnostics.vesicles[0].tension_integral);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(snapshots_are_taken_within_the_steps_at_their_times) {
  const Matrix position = start_shape();
  const EvolutionSetup setup = setup_of(relaxation_model(0.1), position, 4);
  const Run run = run_of(setup, position, {.windows = {{kFrom, kEnd, kEvery}}});
  BOOST_TEST(run.moments.size() == 29U);
  BOOST_TEST(run.step_times.size() < run.moments.size());
  for (std::size_t i = 0; i < run.moments.size(); ++i) {
    BOOST_TEST(std::abs(run.moments[i].state.time - kFrom - kEvery * static_cast<double>(i)) < 1e-12);
    // Keeping the operators of hundreds of them within a step would fill the memory.
    BOOST_TEST(run.moments[i].evaluation.vesicles[0].membrane == nullptr);
  }
}

BOOST_AUTO_TEST_CASE(states_within_a_step_are_as_exact_as_its_end) {
  const Matrix position = start_shape();
  for (const int time_order : {3, 4, 5}) {
    const EvolutionSetup setup = setup_of(field_model(), position, time_order);
    const std::vector<double> times{0.35, 0.9, 1.7, 2.6};
    EvolutionSetup finer = setup;
    finer.settings.time_order = highest_time_order;
    finer.control.tolerance = 1e-2 * kTolerance;
    const Run run = run_of(setup, position, {.times = times});
    const Run exact = run_of(finer, position, {.times = times});
    BOOST_TEST_REQUIRE(run.moments.size() == times.size());
    BOOST_TEST_REQUIRE(exact.moments.size() == times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      const VesicleDiagnostics& d = run.moments[i].evaluation.diagnostics.vesicles[0];
      const VesicleDiagnostics& e = exact.moments[i].evaluation.diagnostics.vesicles[0];
      for (const auto member : {&VesicleDiagnostics::extent_x, &VesicleDiagnostics::extent_z,
                                &VesicleDiagnostics::bending_energy_scaled, &VesicleDiagnostics::Vm_max}) {
        BOOST_TEST(std::abs(d.*member / (e.*member) - 1.0) < 2.0 * kTolerance,
                   "order " << time_order << ", time " << times[i] << ": " << d.*member << " for " << e.*member);
      }
      // Within a step, area and volume are held as accurately as at its end.
      BOOST_TEST(std::abs(d.area_drift) < 1e-8);
      BOOST_TEST(std::abs(d.volume_drift) < 1e-8);
    }
  }
}

// A snapshot must not reduce the step size: if the polynomial of the step is not accurate enough, the state at the
// snapshot is corrected.
BOOST_AUTO_TEST_CASE(steps_do_not_depend_on_snapshots) {
  const Matrix position = start_shape();
  EvolutionSetup setup = setup_of(field_model(), position, highest_time_order);
  setup.control.tolerance = 1e-4;
  const Run plain = run_of(setup, position, {});
  BOOST_TEST_REQUIRE(plain.step_times.size() > 11U);
  for (std::size_t step = 2; step < 12; ++step) {
    for (const double share : {0.25, 0.5, 0.75}) {
      const double time = (1.0 - share) * plain.step_times[step - 1] + share * plain.step_times[step];
      const Run run = run_of(setup, position, {.times = {time}});
      BOOST_TEST(run.moments.size() == 1U);
      BOOST_TEST(run.step_times == plain.step_times, boost::test_tools::per_element());
    }
  }
}

BOOST_AUTO_TEST_CASE(dense_output_contains_no_decayed_transient) {
  // The tension of an ellipsoid has wrinkles that relax in a small part of the first step.
  const Matrix position = ellipsoid(24, {1.0, 1.0, 1.96});
  EvolutionSetup setup = setup_of(relaxation_model(1.0), position, 4);
  setup.control.tolerance = 1e-2;
  EvolutionSetup finer = setup;
  finer.settings.time_order = highest_time_order;
  finer.control.tolerance = 1e-6;
  const std::vector<double> times{0.2, 0.35, 0.45, 0.49};
  const Run run = run_of(setup, position, {.times = times});
  const Run exact = run_of(finer, position, {.times = times});
  BOOST_TEST_REQUIRE(run.moments.size() == times.size());
  BOOST_TEST_REQUIRE(exact.moments.size() == times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double found = run.moments[i].evaluation.diagnostics.vesicles[0].tension_integral;
    const double expected = exact.moments[i].evaluation.diagnostics.vesicles[0].tension_integral;
    BOOST_TEST(std::abs(found / expected - 1.0) < setup.control.tolerance,
               "time " << times[i] << ": " << found << " for " << expected);
  }
}

BOOST_AUTO_TEST_CASE(snapshots_after_a_resumption_are_the_same_to_the_bit) {
  const Matrix position = start_shape();
  const EvolutionSetup setup = setup_of(field_model(), position, 4);
  const SnapshotTimes snapshots{.windows = {{kFrom, kEnd, kEvery}}};
  Instruments instruments;
  Evolution whole(setup, {StartMembrane{position}}, instruments);
  whole.evaluate_start();
  while (whole.dense_output().empty()) whole.step({snapshots, kEnd});
  Evolution resumed(setup, whole.state(), instruments);
  resumed.evaluate_start();
  const Run expected = rest_of(whole, snapshots);
  const Run found = rest_of(resumed, snapshots);
  BOOST_TEST(found.step_times == expected.step_times, boost::test_tools::per_element());
  require_same_bits(found.moments, expected.moments);
}

BOOST_AUTO_TEST_CASE(snapshots_are_the_same_to_the_bit_with_any_number_of_threads) {
  const Matrix position = start_shape();
  const EvolutionSetup setup = setup_of(field_model(), position, 4);
  const SnapshotTimes snapshots{.windows = {{kFrom, kEnd, kEvery}}};
  const auto moments_with = [&](int threads) {
    const ThreadCount count(threads);
    return run_of(setup, position, snapshots).moments;
  };
  const std::vector<Evolution::DenseOutput> alone = moments_with(1);
  for (const int threads : {2, 3}) require_same_bits(moments_with(threads), alone);
}

BOOST_AUTO_TEST_CASE(a_snapshot_at_the_end_of_a_step_is_taken_there) {
  const Matrix position = ellipsoid(12, {1.0, 1.0, 1.2});
  Model model = field_model();
  model.electric->waveform = Waveform::pulse(1.0, 0.0, 0.5);
  Instruments instruments;
  Evolution evolution(setup_of(model, position, 4), {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  int n_moments = 0, n_ends = 0;
  while (evolution.state().time < 1.0) {
    const StepAttempt step = evolution.step({{.times = {0.21, 0.5, 0.83}}, 1.0});
    n_moments += static_cast<int>(evolution.dense_output().size());
    if (evolution.state().time == 0.5) BOOST_TEST(step.at_snapshot);
    if (step.at_snapshot) ++n_ends;
  }
  // Only 0.5, at which the field is switched, and the end are ends of steps; the others lie within steps.
  BOOST_TEST(n_ends == 2);
  BOOST_TEST(n_moments == 2);
}

BOOST_AUTO_TEST_SUITE_END()

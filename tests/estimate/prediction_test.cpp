#include "bie/estimate/prediction.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <regex>

#include "bie/scene/reader.hpp"
#include "bie/scene/shipped_scenes.hpp"
#include "tests/support/files.hpp"

namespace {

const std::vector<double> tolerances{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
constexpr std::size_t index_of_trial = 2;

/// A shipped scene that ends earlier.
vehd::Scene shortened(const std::string& name, const std::string& end_time) {
  const auto scenes = vehd::shipped_scenes();
  const auto found = std::ranges::find(scenes, name, [](const auto& scene) { return std::string(scene.name); });
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml",
             std::regex_replace(std::string(found->text), std::regex("\nend_time = .*"), "\nend_time = " + end_time));
  return vehd::read_scene(directory / "scene.toml");
}

/// What a new shape of degree p costs: p³, in any unit.
double work_of(const vehd::TrialRun& run) {
  double work = 0.0;
  for (const vehd::TrialStep& step : run.steps) work += step.evaluations * std::pow(step.order, 3);
  return work;
}

/// What is known after a trial run, with seconds that are its work.
struct AfterTrial {
  vehd::Scene scene;
  vehd::Knowledge known{scene, tolerances, vehd::CostModel({{8, 8.0 * 8.0 * 8.0, 1.0}, {64, 64.0 * 64.0 * 64.0, 1.0}})};

  AfterTrial(const std::string& name, const std::string& end_time) : scene(shortened(name, end_time)) {
    known.learn(vehd::run_trial(scene, tolerances[index_of_trial], tolerances, {}));
    known.ratio = 1.0;
  }
  void sample(std::size_t index, std::size_t count) {
    known.learn_start(tolerances[index], vehd::starting_order(scene, tolerances[index]));
    known.learn(tolerances[index], vehd::take_stretches(scene, known.trial, tolerances[index], count,
                                                        vehd::predicted_orders(known, index), [] { return true; }));
    known.ratio = 1.0;
  }
};

/// By how much a prediction is wrong, up or down.
double factor(double predicted, double taken) { return std::max(predicted / taken, taken / predicted); }

}  // namespace

BOOST_AUTO_TEST_SUITE(prediction, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

// Two tolerances with stretches of their own, the second of another order, and one that is predicted from these: where
// errors grow and degrees rise, where a field turns, and where a shape comes to rest.
BOOST_AUTO_TEST_CASE(steps_and_work_are_within_a_factor_of_two) {
  for (const auto& [name, end_time] :
       {std::pair("figure3", "8.0"), std::pair("ac_field", "\"1 ms\""), std::pair("relaxation", "10.0")}) {
    AfterTrial after(name, end_time);
    for (std::size_t index = index_of_trial + 1; index < tolerances.size(); ++index) {
      const vehd::TrialRun truth = vehd::run_trial(after.scene, tolerances[index], {}, {});
      after.known.expect_start(tolerances[index]);
      if (index <= index_of_trial + 2) after.sample(index, 10);
      const vehd::CostRow row = predicted_row(after.known, index);
      BOOST_TEST_CONTEXT(name << " at " << tolerances[index] << ": " << row.steps << " steps for " << truth.steps.size()
                              << ", degree " << row.order << " for " << truth.highest_order << ", work "
                              << row.seconds / work_of(truth)) {
        BOOST_TEST(factor(static_cast<double>(row.steps), static_cast<double>(truth.steps.size())) < 2.0);
        BOOST_TEST(factor(row.seconds, work_of(truth)) < 2.0);
      }
    }
  }
}

// Steps with the tighter tolerance are what is predicted: their seconds count, not those of the looser trial run.
BOOST_AUTO_TEST_CASE(seconds_are_those_of_the_stretches) {
  AfterTrial after("relaxation", "1.0");
  vehd::Knowledge& known = after.known;
  known.learn(1e-4, {{.step = 0, .timed = {{8, 3, 2.0 * 3 * std::pow(8, 3)}, {16, 5, 4.0 * 5 * std::pow(16, 3)}}}});
  const double work = 3 * std::pow(8, 3) + 5 * std::pow(16, 3);
  const double seconds = 2.0 * 3 * std::pow(8, 3) + 4.0 * 5 * std::pow(16, 3);
  BOOST_TEST(known.ratio == seconds / work, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()

#include <boost/test/unit_test.hpp>
#include <functional>
#include <memory>

#include "bie/stepping/evolution.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(coarsening)

namespace {

/// Adds no forcing; throws, as a failing solve would, if its condition holds.
class Unsolvable : public ExplicitEffect {
 public:
  using Condition = std::function<bool(const EffectInput&)>;
  explicit Unsolvable(Condition condition) : condition_(std::move(condition)) {}

  [[nodiscard]] EffectDescription description() const override { return {"unsolvable", "nothing", {}, {}}; }
  void add(const EffectInput& input, Forcing&) const override {
    if (condition_(input)) throw ConvergenceError("made to fail");
  }
  [[nodiscard]] bool is_invariant_under(const Reflection&) const override { return true; }
  [[nodiscard]] bool is_axisymmetric() const override { return true; }
  [[nodiscard]] bool is_translation_invariant() const override { return true; }
  [[nodiscard]] std::shared_ptr<const ExplicitEffect> rotated(const Matrix3&) const override {
    return std::make_shared<Unsolvable>(condition_);
  }

 private:
  Condition condition_;
};

Model model_with(Unsolvable::Condition condition) {
  Model model = field_model();
  model.effects.push_back(std::make_shared<Unsolvable>(std::move(condition)));
  return model;
}

int degree(const EffectInput& input) { return order_of(input.position.rows()); }

EvolutionSetup setup_of(const Model& model, const Matrix& position, double tolerance) {
  State shape = at_rest(position);
  EvolutionSetup setup;
  setup.model = model;
  setup.settings.order = order_of(position.rows());
  setup.settings.time_order = 2;
  setup.symmetry = find_symmetry(model, shape);
  setup.control = {1.0, 1e-4, tolerance};
  return setup;
}

/// Evolution from a state whose degree or quadrature is finer than necessary.
Evolution evolution_from(const EvolutionSetup& setup, const Matrix& position, std::int64_t quadrature_level,
                         Instruments& instruments) {
  const double dt = setup.control.tolerance > 0.0 ? 0.0 : setup.control.largest;
  State state = initial_state(setup.model, Discretisation(setup.settings, setup.symmetry), {StartMembrane{position}},
                              dt, instruments);
  state.vesicles[0].quadrature_level = quadrature_level;
  return {setup, std::move(state), instruments};
}

const EventTimes kEvents{{}, 4.0};
constexpr int kSteps = 8;

}  // namespace

BOOST_AUTO_TEST_CASE(degree_that_cannot_be_lowered_stays_and_the_run_goes_on) {
  constexpr int kOrder = 20;
  const Matrix position = ellipsoid(kOrder, {1.0, 1.0, 1.2});
  for (const bool possible : {true, false}) {
    int attempts = 0;
    const Model model = model_with([&](const EffectInput& input) {
      if (degree(input) == kOrder) return false;
      ++attempts;
      return !possible;
    });
    Instruments instruments;
    Evolution evolution = evolution_from(setup_of(model, position, 1e-2), position, 0, instruments);
    evolution.evaluate_start();
    for (int i = 0; i < kSteps; ++i) BOOST_REQUIRE_NO_THROW(evolution.step(kEvents));
    BOOST_TEST((evolution.order(0) < kOrder) == possible);
    BOOST_TEST(attempts > 0);
    // A coarsening that fails is not tried at every step.
    if (!possible) BOOST_TEST(attempts <= kSteps / 2);
  }
}

BOOST_AUTO_TEST_CASE(quadrature_that_cannot_be_coarsened_stays_and_the_run_goes_on) {
  const Matrix position = ellipsoid(16, {1.0, 1.0, 1.2});
  for (const bool possible : {true, false}) {
    double solved_time = -1.0;
    int attempts = 0;
    const Model model = model_with([&](const EffectInput& input) {
      if (input.limit != Limit::after) return false;
      // A second evaluation at the same time has another quadrature.
      const bool again = input.time == solved_time;
      solved_time = input.time;
      if (again) ++attempts;
      return again && !possible;
    });
    EvolutionSetup setup = setup_of(model, position, 0.0);
    setup.control = fixed_steps(0.01);
    Instruments instruments;
    Evolution evolution = evolution_from(setup, position, 1, instruments);
    evolution.evaluate_start();
    for (int i = 0; i < kSteps; ++i) BOOST_REQUIRE_NO_THROW(evolution.step(kEvents));
    BOOST_TEST(evolution.state().vesicles[0].quadrature_level == (possible ? 0 : 1));
    BOOST_TEST(attempts > 0);
    if (!possible) BOOST_TEST(attempts <= kSteps / 2);
  }
}

BOOST_AUTO_TEST_CASE(degree_that_cannot_be_raised_ends_the_run_with_that_reason) {
  constexpr int kHighest = 32;
  const Matrix position = prolate(kHighest);
  int solvable = kHighest;
  const Model model = model_with([&](const EffectInput& input) { return degree(input) > solvable; });
  const EvolutionSetup setup = setup_of(model, position, 1e-3);
  Instruments instruments;
  Evolution evolution(setup, {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  evolution.step({{}, 70.0});
  solvable = evolution.order(0);
  const double begun = evolution.state().time;
  const auto run_until_it_fails = [&] {
    for (int i = 0; i < 1000; ++i) {
      evolution.step({{}, 70.0});
      // The steps before the run stops are smaller, and each is resolved.
      BOOST_TEST_REQUIRE(evolution.truncation() <= thresholds::truncation_share * setup.control.tolerance);
      BOOST_TEST_REQUIRE(evolution.order(0) <= solvable);
    }
  };
  BOOST_CHECK_EXCEPTION(run_until_it_fails(), ConvergenceError, [](const ConvergenceError& error) {
    const std::string text = error.what();
    BOOST_TEST_MESSAGE(text);
    return text.find("no acceptable step from time") == 0 && text.find("leaves out") != std::string::npos &&
           text.find("fails: made to fail") != std::string::npos;
  });
  const double reached = evolution.state().time;
  BOOST_TEST(reached > begun);
  // The failure is not final: once the higher degree can be solved for, the same evolution goes on.
  solvable = kHighest;
  evolution.step({{}, 70.0});
  BOOST_TEST(evolution.state().time > reached);
}

BOOST_AUTO_TEST_SUITE_END()

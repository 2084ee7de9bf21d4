#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

struct Steps {
  State end;
  std::vector<int> iterations;  ///< of the velocity and of the tension at its end, of every step

  [[nodiscard]] int median_from(int first) const {
    std::vector<int> sorted(iterations.begin() + first, iterations.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

/// n steps of size dt at most.
Steps steps_of(const Model& model, const Matrix& position, double dt, int n) {
  const Discretisation discretisation = symmetric_discretisation(model, position);
  Instruments instruments;
  Steps steps{start(model, discretisation, position, dt), {}};
  Evaluation evaluation = evaluate(model, discretisation, steps.end, instruments);
  for (int i = 0; i < n; ++i) {
    const Advance next = advance(model, discretisation, steps.end, evaluation, fixed_steps(dt), dt, instruments);
    BOOST_TEST_REQUIRE(next.accepted, next.reason);
    steps.end = next.state;
    evaluation = evaluate(model, discretisation, steps.end, instruments);
    steps.iterations.push_back(next.iterations_flow + evaluation.iterations_flow);
  }
  return steps;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(flow_memory)

BOOST_AUTO_TEST_CASE(ten_iterations_are_enough_for_a_step_at_every_degree_and_stiffness) {
  for (const int order : {8, 16, 32}) {
    for (const double stiffness : {1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0}) {
      const Steps steps = steps_of(relaxation_model(1.0), ellipsoid(order, {1.0, 1.0, 2.0}), stiffness, 20);
      BOOST_TEST_CONTEXT("degree " << order << ", bending modulus times dt " << stiffness) {
        BOOST_TEST(steps.median_from(4) <= 10);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(ten_iterations_are_enough_for_a_step_of_tank_treading) {
  const Steps steps = steps_of(shear_model(), ellipsoid(12, {2.0, 1.0, 1.0}), 0.1, 30);
  BOOST_TEST(steps.iterations.front() > 20);
  BOOST_TEST(steps.median_from(20) <= 10);
}

BOOST_AUTO_TEST_CASE(what_was_learned_changes_the_step_by_less_than_its_tolerance) {
  const Model model = shear_model();
  const Matrix position = ellipsoid(10, {2.0, 1.0, 0.9});
  const State learned = steps_of(model, position, 0.1, 10).end;
  BOOST_TEST_REQUIRE(learned.flow_memory.flow != nullptr);
  State forgetful = learned;
  forgetful.flow_memory = {};
  const Discretisation discretisation = symmetric_discretisation(model, position);
  const StepResult with = stepped(model, discretisation, learned, 0.1);
  const StepResult without = stepped(model, discretisation, forgetful, 0.1);
  BOOST_TEST(3 * with.iterations_flow < 2 * without.iterations_flow);
  BOOST_TEST(max_difference(with.state.position, without.state.position) < 1e-7);
}

BOOST_AUTO_TEST_CASE(what_does_not_pay_is_left_aside_for_a_while) {
  const auto known = std::make_shared<const KnownResponses>();
  FlowMemory memory = memory_after_step({}, known, 20);
  BOOST_TEST((memory.flow == known && memory.unaided_iterations == 20));
  memory = memory_after_step(memory, known, 40);
  BOOST_TEST((memory.flow == known && memory.unaided_iterations == 20));
  memory = memory_after_step(memory, known, 41);
  int steps = 0;
  for (; !memory.flow && steps < 1000; ++steps) memory = memory_after_step(memory, known, 25);
  BOOST_TEST(steps == 50);
  BOOST_TEST((memory.pause == 0 && memory.unaided_iterations == 25));
}

BOOST_AUTO_TEST_CASE(memory_stays_bounded) {
  const Steps steps = steps_of(shear_model(), ellipsoid(8, {2.0, 1.0, 0.9}), 0.1, 20);
  BOOST_TEST(steps.end.flow_memory.flow->count() <= most_known_responses);
  BOOST_TEST(steps.end.flow_memory.tension->count() <= most_known_responses);
}

BOOST_AUTO_TEST_SUITE_END()

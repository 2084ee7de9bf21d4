#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "bie/stepping/state/frame.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

struct Steps {
  State end;
  std::vector<int> iterations;  ///< of the velocity and of the tension at its end, for every step

  [[nodiscard]] int median_from(int first) const {
    std::vector<int> sorted(iterations.begin() + first, iterations.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

/// n steps of size dt.
Steps steps_of(const Model& model, const Matrix& position, double dt, int n) {
  const Discretisation discretisation = symmetric_discretisation(model, position);
  Instruments instruments;
  Steps steps{start(model, discretisation, position, dt), {}};
  Evaluation evaluation = evaluate(model, discretisation, steps.end, instruments);
  for (int i = 0; i < n; ++i) {
    const StepAttempt next = attempt_step({model, discretisation, steps.end, evaluation}, dt, instruments);
    BOOST_TEST_REQUIRE(next.accepted, next.reason);
    steps.end = next.state;
    evaluation = evaluate(model, discretisation, steps.end, instruments);
    steps.iterations.push_back(next.iterations_flow + evaluation.iterations_flow);
  }
  return steps;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(recycled_subspaces)

BOOST_AUTO_TEST_CASE(steps_come_to_take_few_iterations_at_every_degree_and_stiffness) {
  for (const int order : {8, 16, 32}) {
    for (const double stiffness : {1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0}) {
      const Steps steps = steps_of(relaxation_model(1.0), ellipsoid(order, {1.0, 1.0, 2.0}), stiffness, 20);
      BOOST_TEST_CONTEXT("degree " << order << ", bending modulus times dt " << stiffness) {
        BOOST_TEST(steps.median_from(4) <= 15);
        BOOST_TEST(steps.median_from(4) < steps.iterations.front());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(steps_of_tank_treading_come_to_take_less_than_half_the_iterations) {
  const Steps steps = steps_of(shear_model(), ellipsoid(12, {2.0, 1.0, 1.0}), 0.1, 30);
  BOOST_TEST(2 * steps.median_from(20) < steps.iterations.front());
}

BOOST_AUTO_TEST_CASE(recycling_changes_the_step_by_less_than_its_tolerance) {
  const Model model = shear_model();
  const Matrix position = ellipsoid(10, {2.0, 1.0, 0.9});
  const State learned = steps_of(model, position, 0.1, 10).end;
  BOOST_TEST_REQUIRE(learned.vesicles[0].recycled.flow != nullptr);
  State forgetful = learned;
  forgetful.vesicles[0].recycled = {};
  const Discretisation discretisation = symmetric_discretisation(model, position);
  const StepAttempt with = stepped(model, discretisation, learned, 0.1);
  const StepAttempt without = stepped(model, discretisation, forgetful, 0.1);
  BOOST_TEST(max_difference(with.state.vesicles[0].position, without.state.vesicles[0].position) < 1e-7);
}

BOOST_AUTO_TEST_CASE(a_repeated_step_takes_fewer_iterations) {
  // Recycling from other steps depends on rounding, since nearly parallel directions are left out; recycling from the
  // same step works on any processor.
  const Model model = shear_model();
  const Matrix position = ellipsoid(10, {2.0, 1.0, 0.9});
  const Discretisation discretisation = symmetric_discretisation(model, position);
  State state = start(model, discretisation, position, 0.1);
  state.vesicles[0].recycled = {};
  const StepAttempt unaided = stepped(model, discretisation, state, 0.1);
  state.vesicles[0].recycled = unaided.state.vesicles[0].recycled;
  BOOST_TEST_REQUIRE(state.vesicles[0].recycled.flow != nullptr);
  const StepAttempt again = stepped(model, discretisation, state, 0.1);
  BOOST_TEST(again.iterations_flow < unaided.iterations_flow);
  BOOST_TEST(max_difference(again.state.vesicles[0].position, unaided.state.vesicles[0].position) < 1e-7);
}

BOOST_AUTO_TEST_CASE(recycling_that_does_not_pay_is_suspended) {
  const auto known = recycled_scalars({0}, {Matrix::Ones(1, 1), Matrix::Ones(1, 1)});
  RecycledSubspaces memory = after_step({}, known, 20);
  BOOST_TEST((memory.flow == known && memory.unaided_iterations == 20));
  memory = after_step(memory, known, 40);
  BOOST_TEST((memory.flow == known && memory.unaided_iterations == 20));
  memory = after_step(memory, known, 41);
  int steps = 0;
  for (; !memory.flow && steps < 1000; ++steps) memory = after_step(memory, known, 25);
  BOOST_TEST(steps == 50);
  BOOST_TEST((memory.pause == 0 && memory.unaided_iterations == 25));
}

BOOST_AUTO_TEST_CASE(memory_stays_bounded) {
  const Steps steps = steps_of(shear_model(), ellipsoid(8, {2.0, 1.0, 0.9}), 0.1, 20);
  BOOST_TEST(steps.end.vesicles[0].recycled.flow->subspace().count() <= thresholds::most_recycled);
  BOOST_TEST(steps.end.vesicles[0].recycled.tension->subspace().count() <= thresholds::most_recycled);
}

BOOST_AUTO_TEST_CASE(subspaces_are_returned_in_their_own_coefficients_only) {
  constexpr int kOrder = 4;
  const std::vector<Index> all = scalar_entries({}, kOrder);
  const Matrix arguments = random_coefficients(kOrder, 2, 1);
  Matrix both(2 * arguments.rows(), 2);
  both << arguments, -arguments;
  const RecycledScalars known(all, {both, 3.0 * both});
  BOOST_TEST((known.in(all, 2).arguments == both));
  BOOST_TEST((known.in(all, 2).responses == 3.0 * both));
  BOOST_TEST(known.in(all, 1).count() == 0);
  BOOST_TEST(known.in(scalar_entries({}, kOrder - 1), 2).count() == 0);
  // Another symmetry or degree may have as many rows as two of these scalars, by chance.
  std::vector<Index> others = all;
  others.back() += 1;
  BOOST_TEST(known.in(others, 2).count() == 0);
  BOOST_CHECK_THROW(RecycledScalars(scalar_entries({}, kOrder + 1), {both, both}), ShapeError);
  BOOST_CHECK_THROW(RecycledScalars(all, {both, arguments}), ShapeError);
}

BOOST_AUTO_TEST_CASE(rotated_state_keeps_no_subspace_of_former_axes) {
  const State learned = steps_of(shear_model(), ellipsoid(6, {2.0, 1.0, 0.9}), 0.1, 1).end;
  BOOST_TEST_REQUIRE((learned.vesicles[0].recycled.flow && learned.vesicles[0].recycled.tension));
  const State there = rotated(general_rotation(), learned);
  BOOST_TEST((!there.vesicles[0].recycled.flow && !there.vesicles[0].recycled.tension));
  const State here = rotated(Matrix3::Identity(), learned);
  BOOST_TEST((here.vesicles[0].recycled.flow == learned.vesicles[0].recycled.flow));
}

BOOST_AUTO_TEST_CASE(resized_state_keeps_no_subspace_of_the_former_degree) {
  const State learned = steps_of(shear_model(), ellipsoid(6, {2.0, 1.0, 0.9}), 0.1, 1).end;
  BOOST_TEST_REQUIRE((learned.vesicles[0].recycled.flow && learned.vesicles[0].recycled.tension));
  for (const int order : {4, 9}) {
    const RecycledSubspaces memory = resized(learned, order).vesicles[0].recycled;
    BOOST_TEST((!memory.flow && !memory.tension));
  }
  BOOST_TEST((resized(learned, 6).vesicles[0].recycled.flow == learned.vesicles[0].recycled.flow));
}

// Higher and lower degrees and a smaller symmetry, also if the outdated subspace is left in the state.
BOOST_AUTO_TEST_CASE(samples_of_another_degree_change_no_field_and_no_step) {
  const Model model = shear_model();
  const Matrix position = ellipsoid(10, {2.0, 1.0, 0.9});
  const State learned = steps_of(model, position, 0.1, 4).end;
  for (const int order : {8, 10, 13}) {
    State with = resized(learned, order);
    with.vesicles[0].recycled = learned.vesicles[0].recycled;
    State without = with;
    without.vesicles[0].recycled = {};
    for (const bool symmetric : {true, false}) {
      const Discretisation discretisation =
          symmetric ? symmetric_discretisation(model, resize_order(position, order)) : discretisation_of(order);
      BOOST_TEST_CONTEXT("degree " << order << (symmetric ? ", symmetric" : "")) {
        const VesicleFields expected = evaluated(model, discretisation, without).fields;
        const VesicleFields fields = evaluated(model, discretisation, with).fields;
        BOOST_TEST(relative_difference(fields.velocity, expected.velocity) < 1e-7);
        BOOST_TEST(relative_difference(fields.tension, expected.tension) < 1e-7);
        const StepAttempt step = stepped(model, discretisation, with, 0.1);
        const StepAttempt unaided = stepped(model, discretisation, without, 0.1);
        BOOST_TEST_REQUIRE((step.accepted && unaided.accepted));
        BOOST_TEST(max_difference(step.state.vesicles[0].position, unaided.state.vesicles[0].position) < 1e-7);
        const Index rows = step.state.vesicles[0].recycled.flow->subspace().arguments.rows();
        BOOST_TEST(rows == 2 * static_cast<Index>(step.state.vesicles[0].recycled.flow->entries().size()));
        // The changes of H in a step have one degree more.
        BOOST_TEST(
            (step.state.vesicles[0].recycled.flow->entries() == scalar_entries(discretisation.symmetry(), order + 1)));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

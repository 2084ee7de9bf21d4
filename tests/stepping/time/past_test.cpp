#include "bie/stepping/time/past.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/time/collocation.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kDegreeOfPast = 16;

/// A vesicle in shear and in a field across it.
Model driven_model() {
  Model model = field_model();
  model.flow = shear_flow(1.0);
  return model;
}

/// One step of a size at which sweeps converge.
class ConvergedStep {
 public:
  ConvergedStep(const Model& model, const Discretisation& discretisation, const State& state, double dt)
      : at_start_(solve_fields(model, discretisation, state, instruments_)),
        physics_({model, discretisation, state, at_start_}, instruments_),
        rule_(time_rule(highest_time_order)),
        y_(physics_, rule_, dt, NodeEnd::material) {
    constexpr int kSweeps = 7;
    for (int sweep = 1; sweep <= kSweeps; ++sweep) {
      y_.evaluate_rates();
      y_.replace(y_.all_corrected(sweep < kSweeps ? NodeEnd::material : NodeEnd::remapped));
    }
  }

  /// State at the end of the step, with the history for the next step.
  [[nodiscard]] State end() const {
    State state = physics_.end_state(y_.node(y_.last()));
    store_past(physics_.start(), y_.nodes(), state);
    return state;
  }
  /// Largest error of the nodes extrapolated from the history of the start: of x over the radius and V_m over its size.
  [[nodiscard]] double error_of_past() const {
    double largest = 0.0;
    for (const NodeSolution& node : y_.nodes()) {
      largest = std::max(largest, difference(physics_.start(), extrapolated(physics_.start(), node.time), node));
    }
    return largest;
  }
  [[nodiscard]] bool can_extrapolate(double dt) const { return vehd::can_extrapolate(physics_.start().state, dt); }

 private:
  Instruments instruments_;
  SolvedFields at_start_;
  StepOperations physics_;
  TimeRule rule_;
  Collocation y_;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(past)

BOOST_AUTO_TEST_CASE(extrapolation_has_one_order_more_than_it_has_times) {
  const Model model = driven_model();
  const Matrix position = ellipsoid(kDegreeOfPast, {1.5, 1.2, 0.9});
  NumericalSettings settings = solved_to_rounding(kDegreeOfPast);
  settings.time_order = highest_time_order;
  const Discretisation discretisation(settings);
  std::vector<double> errors;
  // By then, transients that decay within a step are over, and only smooth motions remain.
  const State begun = run(model, discretisation, start(model, discretisation, position, 0.05), 0.05, 8);
  for (const double dt : {0.16, 0.08, 0.04}) {
    const State state = ConvergedStep(model, discretisation, begun, dt).end();
    BOOST_TEST_REQUIRE(state.past_times.size() == 3);
    BOOST_TEST(state.past_times[0] == -dt, boost::test_tools::tolerance(1e-12));
    const ConvergedStep next(model, discretisation, state, dt);
    BOOST_TEST(next.can_extrapolate(1.9 * dt));
    BOOST_TEST(!next.can_extrapolate(2.1 * dt));
    errors.push_back(next.error_of_past());
    BOOST_TEST_MESSAGE("dt " << dt << ": " << errors.back());
  }
  BOOST_TEST(std::log2(errors.front() / errors.back()) / 2.0 > 3.5);
  BOOST_TEST(errors.back() < 1e-4);
}

BOOST_AUTO_TEST_CASE(rigid_spheres_have_no_past) {
  Model model = shear_model();
  const Discretisation discretisation = discretisation_of(8);
  const State begun = start(model, discretisation, sphere(8, 1.3), 0.05);
  const State state = ConvergedStep(model, discretisation, begun, 0.05).end();
  BOOST_TEST(state.past_times.size() == 0);
  BOOST_TEST(state.vesicles[0].past.size() == 0);
}

namespace {

/// History of x and one scalar, each coefficient being this function of time, times its own amplitude.
template <typename Motion>
Matrix past_of(const Vector& times, const Motion& motion) {
  const Matrix amplitude = smooth_coefficients(kDegreeOfPast, 4, kDegreeOfPast, 17);
  Matrix past(amplitude.rows(), 4 * times.size());
  for (Index j = 0; j < times.size(); ++j) past.middleCols(4 * j, 4) = (motion(times[j]) - motion(0.0)) * amplitude;
  return past;
}

}  // namespace

BOOST_AUTO_TEST_CASE(smooth_past_stays_as_it_is) {
  const Vector times{{-1.0, -0.845, -0.355}};
  const Matrix past = past_of(times, [](double t) { return std::exp(0.3 * t) + 0.2 * std::sin(0.4 * t + 1.0); });
  BOOST_TEST((smooth_past(times, past) == past));
}

BOOST_AUTO_TEST_CASE(noise_of_a_degree_is_continued_by_a_straight_line_and_others_are_not_touched) {
  const Vector times{{-1.0, -0.845, -0.355}};
  const Matrix past = past_of(times, [](double t) { return std::exp(0.3 * t); });
  Matrix noisy = past;
  constexpr int kDegree = 5;
  const auto of_degree = Eigen::seqN(coefficient_index(kDegree, -kDegree), 2 * kDegree + 1);
  // Noise only in the scalar, with signs that no polynomial follows.
  noisy(of_degree, 3).setConstant(1.0);
  noisy(of_degree, 7).setConstant(-1.0);
  noisy(of_degree, 11).setConstant(1.0);
  const Matrix smooth = smooth_past(times, noisy);
  for (Index j = 0; j < 3; ++j) {
    BOOST_TEST((smooth(of_degree, 4 * j + 3).array() - times[j] / times[2]).abs().maxCoeff() < 1e-14);
  }
  Matrix rest = smooth;
  for (const Index column : {3, 7, 11}) rest(of_degree, column) = past(of_degree, column);
  BOOST_TEST((rest == past));
}

BOOST_AUTO_TEST_SUITE_END()

#include "bie/stepping/evaluation/smallest_gap.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(smallest_gap)

namespace {

SmallestGap gap_of(double relative) { return {2.0 * relative, relative, 2.0, 1, 3, {0.0, 0.0, 1.0}}; }

/// Reason why a step from one gap over the radius to another is refused; empty if it is not.
std::string reason(double before, double after) {
  Frame frame;
  frame.origin = Vector3(1.0, 0.0, 0.0);
  try {
    require_gap(gap_of(after), gap_of(before), 0.2, frame, {"a", "b", "c", "d"});
  } catch (const ConvergenceError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(steps_that_jump_or_touch_are_refused) {
  BOOST_TEST(reason(0.3, 0.16).empty());
  BOOST_TEST(reason(0.1, 0.3).empty());
  // Wide gaps may close at any speed down to the spacing of the grid.
  BOOST_TEST(reason(2.0, 0.25).empty());
  BOOST_TEST(reason(0.3, 0.14) ==
             "vesicles \"b\" and \"d\" come within 0.14 radii of each other at (1, 0, 1) in one step, from 0.3");
  BOOST_TEST(reason(2.0, 0.19).ends_with("in one step, from 2"));
  BOOST_TEST(reason(0.0015, 0.00095)
                 .starts_with("vesicles \"b\" and \"d\" come within 0.00095 radii of each other at (1, 0, 1); "
                              "accepted: at least 0.001, "));
  BOOST_TEST(reason(0.3, -0.1).find(" within 0 radii of ") != std::string::npos);
  // At the start of a run there is no previous gap.
  BOOST_TEST(reason(std::numeric_limits<double>::infinity(), 0.01).empty());
}

BOOST_AUTO_TEST_CASE(the_gap_is_measured_by_the_smaller_vesicle) {
  BOOST_TEST(find_smallest_gap(at_rest(sphere(6)), Discretisation({.order = 6}), {}, 0.0).degree() == 0.0);
  const std::vector<Matrix> spheres{sphere(6), translated(0.5 * sphere(6), {2.0, 0.0, 0.0})};
  State state = at_rest(spheres);
  state.vesicles[0].reference_area = 16.0 * std::numbers::pi / 4.0;
  state.vesicles[1].reference_area = std::numbers::pi;
  const SmallestGap gap = find_smallest_gap(state, Discretisation({.order = 6}, {}, {2, ResolutionLevel{6}}), {}, 1e-3);
  BOOST_TEST(std::abs(gap.distance - 0.5) < 1e-12);
  BOOST_TEST(std::abs(gap.relative - 1.0) < 1e-12);
  BOOST_TEST((gap.place - Vector3(1.25, 0.0, 0.0)).norm() < 1e-6);
  BOOST_TEST(std::abs(gap.degree() - thresholds::degrees_of_gap(1e-3)) < 1e-12);
}

// A small pair with the smallest gap, but the widest for its size, a large pair, and a fifth sphere far away.
BOOST_AUTO_TEST_CASE(every_vesicle_has_the_degree_of_its_own_gaps) {
  const Matrix large = sphere(6), small = 0.1 * large;
  State state =
      at_rest(std::vector<Matrix>{large, translated(large, {2.2, 0.0, 0.0}), translated(small, {0.0, 9.0, 0.0}),
                                  translated(small, {0.25, 9.0, 0.0}), translated(large, {0.0, 0.0, 40.0})});
  for (std::size_t a = 0; a < 5; ++a) {
    state.vesicles[a].reference_area = 4.0 * std::numbers::pi * (a == 2 || a == 3 ? 0.01 : 1.0);
  }
  const SmallestGap gap = find_smallest_gap(state, Discretisation({.order = 6}, {}, {5, ResolutionLevel{6}}), {}, 1e-4);
  BOOST_TEST(gap.first == 2);
  BOOST_TEST(gap.second == 3);
  const double one = thresholds::degrees_of_gap(1e-4);
  const std::vector<double> expected{one / std::sqrt(0.2), one / std::sqrt(0.2), one / std::sqrt(0.5),
                                     one / std::sqrt(0.5), 0.0};
  for (std::size_t a = 0; a < 5; ++a) BOOST_TEST(std::abs(gap.degrees[a] - expected[a]) < 1e-9);
  BOOST_TEST(gap.degree() == gap.degrees[0]);
}

BOOST_AUTO_TEST_SUITE_END()

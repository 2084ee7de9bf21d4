#include "bie/stepping/evaluation/smallest_gap.hpp"

#include <boost/test/unit_test.hpp>

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
  BOOST_TEST(
      reason(0.0015, 0.00095)
          .starts_with(
              "vesicles \"b\" and \"d\" come within 0.00095 radii of each other at (1, 0, 1); accepted: 0.001, "));
  BOOST_TEST(reason(0.3, -0.1).find(" within 0 radii of ") != std::string::npos);
  // At the start of a run there is no previous gap.
  BOOST_TEST(reason(std::numeric_limits<double>::infinity(), 0.01).empty());
}

BOOST_AUTO_TEST_CASE(the_gap_is_measured_by_the_smaller_vesicle) {
  BOOST_TEST(find_smallest_gap(at_rest(sphere(6)), Discretisation({.order = 6}), {}).degree() == 0.0);
  const std::vector<Matrix> spheres{sphere(6), translated(0.5 * sphere(6), {2.0, 0.0, 0.0})};
  State state = at_rest(spheres);
  state.vesicles[0].reference_area = 16.0 * std::numbers::pi / 4.0;
  state.vesicles[1].reference_area = std::numbers::pi;
  const SmallestGap gap = find_smallest_gap(state, Discretisation({.order = 6}, {}, {2, ResolutionLevel{6}}), {});
  BOOST_TEST(std::abs(gap.distance - 0.5) < 1e-12);
  BOOST_TEST(std::abs(gap.relative - 1.0) < 1e-12);
  BOOST_TEST((gap.place - Vector3(1.25, 0.0, 0.0)).norm() < 1e-6);
  BOOST_TEST(std::abs(gap.degree() - 4.0) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()

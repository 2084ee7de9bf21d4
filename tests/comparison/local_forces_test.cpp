#include <boost/test/unit_test.hpp>

#include "bie/comparison/check.hpp"
#include "bie/comparison/check_fields.hpp"
#include "bie/sphere/harmonics.hpp"

BOOST_AUTO_TEST_SUITE(local_forces)

namespace {

vehd::FrozenState frozen(const std::string& axes, int degree) {
  return vehd::read_frozen_state({"scene.toml",
                                  {},
                                  "[shape]\nkind = 'ellipsoid'\naxes = " + axes +
                                      "\nrotation = [1.0, 2.0, 0.5, 40.0]\n"
                                      "[membrane]\nbending_modulus = 0.1\nspontaneous_curvature = -0.5\n"
                                      "[numerics]\ndt = 0.1\nend_time = 0.0\ndegree = " +
                                      std::to_string(degree) + "\n"},
                                 std::nullopt);
}

double difference(const vehd::Matrix& a, const vehd::Matrix& b) {
  const int order = vehd::order_of(std::max(a.rows(), b.rows()));
  const vehd::Matrix whole = vehd::resize_order(b, order);
  return (vehd::resize_order(a, order) - whole).norm() / whole.norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(degrees_beyond_those_of_layers_resolve_bent_ends) {
  const vehd::FrozenState needle = frozen("[0.6, 0.6, 3.0]", 56);
  const vehd::Matrix coarse = vehd::local_forces(needle, 56).bending, fine = vehd::local_forces(needle, 112).bending,
                     finest = vehd::local_forces(needle, 168).bending;
  BOOST_TEST_MESSAGE(difference(coarse, finest) << " " << difference(fine, finest));
  BOOST_TEST(difference(coarse, finest) > 5e-3);
  BOOST_TEST(difference(coarse, finest) < 3e-2);
  BOOST_TEST(difference(fine, finest) < 1e-5);
}

// A few degrees more change f_b by only a part of the remaining error, and that part is unknown.
BOOST_AUTO_TEST_CASE(other_degree_of_f_b_is_high_where_that_of_the_layers_is_not) {
  const vehd::FrozenState prolate = frozen("[1.0, 1.0, 3.0]", 24);
  vehd::CheckProblem problem = vehd::check_problem(prolate);
  problem.samples = {};
  const auto at = [&](int order) { return vehd::check_fields(problem, {order}).front(); };
  const vehd::CheckFields run = at(24), other = at(vehd::estimate_order(24, true));
  BOOST_TEST(other.order == 28);
  BOOST_TEST(other.force_order == 48);
  BOOST_TEST(run.force_order == 24);
  const vehd::LocalForces exact = vehd::local_forces(prolate, 96);
  const double error = difference(run.force_bending, exact.bending);
  BOOST_TEST_MESSAGE(error);
  BOOST_TEST(error > 1e-3);
  BOOST_TEST(difference(run.force_bending, other.force_bending) == error, boost::test_tools::tolerance(0.02));
  BOOST_TEST(difference(run.force_curvature, other.force_curvature) == difference(run.force_curvature, exact.curvature),
             boost::test_tools::tolerance(0.02));
}

BOOST_AUTO_TEST_SUITE_END()

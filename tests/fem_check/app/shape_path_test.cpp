#include "fem_check/app/shape_path.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

BOOST_AUTO_TEST_SUITE(shape_path)

namespace {

using vehd::fem_check::InTime;
using vehd::fem_check::ShapePath;

Eigen::MatrixXd at_rest() { return Eigen::MatrixXd::Constant(4, 3, 0.25); }

double coefficient(double time, int degree) { return 2.0 + std::pow(time - 0.3, degree); }
double rate(double time, int degree) { return degree * std::pow(time - 0.3, degree - 1); }

/// x is proportional to a power of time; the material moves by half of x.
InTime snapshots(const std::vector<double>& times, int degree) {
  InTime result;
  result.shape_times = Eigen::Map<const Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size()));
  for (const double time : times) {
    result.positions.emplace_back(coefficient(time, degree) * at_rest());
    result.velocities.emplace_back(0.5 * rate(time, degree) * at_rest());
  }
  return result;
}

bool is(const Eigen::MatrixXd& values, double factor) {
  return (values - factor * at_rest()).cwiseAbs().maxCoeff() < 1e-13;
}

}  // namespace

BOOST_AUTO_TEST_CASE(motion_of_degree_three_is_followed_exactly) {
  const ShapePath path(snapshots({0.0, 0.2, 0.5, 0.6, 1.0, 1.3}, 3));
  for (const double time : {0.0, 0.1, 0.2, 0.55, 0.9, 1.2, 1.3}) {
    BOOST_TEST(is(path.position(time), coefficient(time, 3)), time);
    BOOST_TEST(is(path.sliding(time), 0.5 * rate(time, 3)), time);
  }
}

BOOST_AUTO_TEST_CASE(two_snapshots_make_a_line) {
  const ShapePath path(snapshots({0.0, 0.5}, 1));
  BOOST_TEST(is(path.position(0.1), coefficient(0.1, 1)));
  BOOST_TEST(is(path.sliding(0.1), 0.5));
}

BOOST_AUTO_TEST_CASE(coarser_path_keeps_both_ends_and_is_another_one_between) {
  const ShapePath path(snapshots({0.0, 0.2, 0.5, 0.6}, 3)), coarser = path.coarser();
  for (const double time : {0.0, 0.5, 0.6}) BOOST_TEST(is(coarser.position(time), coefficient(time, 3)), time);
  BOOST_TEST(!is(coarser.position(0.2), coefficient(0.2, 3)));
  const ShapePath still = ShapePath(snapshots({0.0, 0.5}, 1)).coarser();
  BOOST_TEST(is(still.position(0.1), coefficient(0.5, 1)));
  BOOST_TEST(is(still.sliding(0.1), 0.0));
}

BOOST_AUTO_TEST_SUITE_END()

#include "fem_check/app/surface_divergence.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/meshes/shapes.hpp"

using vehd::fem_check::surface_divergence;

BOOST_AUTO_TEST_SUITE(surface_divergence_of_series)

BOOST_AUTO_TEST_CASE(position_has_two_rotation_and_translation_none) {
  const auto body = [](const vehd::meshes::Point& r) { return vehd::meshes::Point(1.1 * r.x(), r.y(), 2.0 * r.z()); };
  const Eigen::MatrixXd x = vehd::meshes::testing::project(1, body);
  const Eigen::MatrixXd moved = vehd::meshes::testing::project(1, [&](const vehd::meshes::Point& r) {
    return vehd::meshes::Point(vehd::meshes::Point(0.3, -0.2, 0.9).cross(body(r)) + vehd::meshes::Point(1.0, 2.0, 3.0));
  });
  Eigen::Matrix3Xd directions = Eigen::Matrix3Xd::Random(3, 20);
  directions.colwise().normalize();
  BOOST_TEST((surface_divergence(x, x, directions).array() - 2.0).abs().maxCoeff() < 1e-13);
  BOOST_TEST(surface_divergence(x, moved, directions).cwiseAbs().maxCoeff() < 1e-13);
}

// For v = A x on the sphere, ∇_γ·v is tr A − n·A n.
BOOST_AUTO_TEST_CASE(linear_flow_on_the_sphere) {
  const Eigen::Matrix3d gradient{{0.1, 0.7, -0.2}, {0.3, 0.4, 0.0}, {0.5, -0.6, -0.5}};
  const auto sphere = [](const vehd::meshes::Point& r) { return vehd::meshes::Point(2.0 * r); };
  const Eigen::MatrixXd x = vehd::meshes::testing::project(1, sphere);
  const Eigen::MatrixXd v = vehd::meshes::testing::project(
      1, [&](const vehd::meshes::Point& r) { return vehd::meshes::Point(gradient * sphere(r)); });
  Eigen::Matrix3Xd directions = Eigen::Matrix3Xd::Random(3, 20);
  directions.colwise().normalize();
  const Eigen::VectorXd found = surface_divergence(x, v, directions);
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    const Eigen::Vector3d n = directions.col(i);
    BOOST_TEST(std::abs(found[i] - (gradient.trace() - n.dot(gradient * n))) < 1e-13);
  }
}

BOOST_AUTO_TEST_SUITE_END()

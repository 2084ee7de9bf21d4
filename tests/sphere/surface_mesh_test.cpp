#include "bie/sphere/surface_mesh.hpp"

#include <Eigen/Dense>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "bie/sphere/harmonics.hpp"

BOOST_AUTO_TEST_SUITE(surface_mesh)

BOOST_AUTO_TEST_CASE(every_edge_has_two_triangles_in_opposite_directions) {
  const vehd::SphereGrid grid = vehd::make_grid(5);
  const auto triangles = vehd::closed_triangles(grid);
  std::map<std::pair<std::int64_t, std::int64_t>, int> edges;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    for (int k = 0; k < 3; ++k) ++edges[{triangles[i + k], triangles[i + (k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    BOOST_TEST(count == 1);
    BOOST_TEST(edges.count({edge.second, edge.first}) == 1);
  }
  // Euler: V - E + F = 2
  const auto n_triangles = static_cast<std::int64_t>(triangles.size() / 3);
  BOOST_TEST(grid.n_points() + 2 - static_cast<std::int64_t>(edges.size()) / 2 + n_triangles == 2);
}

BOOST_AUTO_TEST_CASE(triangles_of_the_sphere_point_outward_and_enclose_its_volume) {
  const vehd::SphereGrid grid = vehd::make_grid(31);
  vehd::Matrix coefficients = vehd::Matrix::Zero(vehd::n_coefficients(1), 3);
  const double unit = std::sqrt(4.0 * std::numbers::pi / 3.0);
  coefficients(vehd::coefficient_index(1, 1), 0) = unit;
  coefficients(vehd::coefficient_index(1, -1), 1) = unit;
  coefficients(vehd::coefficient_index(1, 0), 2) = unit;
  vehd::Matrix values(grid.n_points(), 3);
  for (int j = 0; j < grid.n_theta; ++j) {
    for (int k = 0; k < grid.n_phi; ++k) {
      const double s = std::sin(grid.theta(j));
      values.row(j * grid.n_phi + k) << s * std::cos(grid.phi(k)), s * std::sin(grid.phi(k)), std::cos(grid.theta(j));
    }
  }
  const vehd::Matrix points = vehd::with_poles(values, coefficients);
  BOOST_TEST(points.row(grid.n_points()).isApprox(Eigen::RowVector3d(0, 0, 1), 1e-14));
  BOOST_TEST(points.row(grid.n_points() + 1).isApprox(Eigen::RowVector3d(0, 0, -1), 1e-14));
  const auto triangles = vehd::closed_triangles(grid);
  double volume = 0.0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const vehd::Vector3 a = points.row(triangles[i]), b = points.row(triangles[i + 1]),
                        c = points.row(triangles[i + 2]);
    const double part = a.dot(b.cross(c)) / 6.0;
    BOOST_TEST_REQUIRE(part > 0.0);
    volume += part;
  }
  BOOST_TEST(std::abs(volume / (4.0 * std::numbers::pi / 3.0) - 1.0) < 0.01);
}

BOOST_AUTO_TEST_SUITE_END()

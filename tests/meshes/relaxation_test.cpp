#include "meshes/relaxation.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "meshes/gauss_rule.hpp"

using namespace vehd::meshes;

BOOST_AUTO_TEST_SUITE(relaxation)

namespace {

constexpr double kCoreHalfWidth = 0.35;

Lattice inside_lattice() { return {Region::inside, 2, 2, {0.0, 1.0}}; }

/// Nodes of a ball divided into blocks.
Eigen::Matrix3Xd ball(const Lattice& lattice) {
  Eigen::Matrix3Xd result(3, lattice.nodes().size());
  for (Eigen::Index i = 0; i < result.cols(); ++i) {
    const BlockPlace& place = lattice.nodes()[static_cast<std::size_t>(i)].place;
    if (place.block.layer == Block::Layer::core) {
      result.col(i) = kCoreHalfWidth * place.at;
      continue;
    }
    Point v;
    v[place.block.axis] = place.block.sign;
    v[(place.block.axis + 1) % 3] = place.at.x();
    v[(place.block.axis + 2) % 3] = place.at.y();
    result.col(i) = (1.0 - place.at.z()) * kCoreHalfWidth * v + place.at.z() * v.normalized();
  }
  return result;
}

/// A smooth displacement without symmetry.
Point wave(const Point& x) {
  return {std::sin(2.0 * x.y() + x.z()), std::cos(1.5 * x.x() - x.y()), std::sin(x.x() + 2.0 * x.z())};
}

Eigen::Matrix3Xd displaced(const Eigen::Matrix3Xd& nodes, double size) {
  Eigen::Matrix3Xd result = nodes;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) result.col(i) += size * wave(nodes.col(i));
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(lobatto_rule_has_both_ends_and_integrates_degree_two_n_minus_three) {
  for (int n = 2; n <= 9; ++n) {
    const GaussRule rule = lobatto_rule(n);
    BOOST_TEST(rule.node.front() == -1.0);
    BOOST_TEST(rule.node.back() == 1.0);
    for (int power = 0; power <= 2 * n - 3; ++power) {
      double sum = 0.0;
      for (std::size_t i = 0; i < rule.node.size(); ++i) sum += rule.weight[i] * std::pow(rule.node[i], power);
      BOOST_TEST(std::abs(sum - (power % 2 == 0 ? 2.0 / (power + 1) : 0.0)) < 1e-13, n << " " << power);
    }
  }
}

BOOST_AUTO_TEST_CASE(energy_of_a_stretch_is_that_of_the_formula) {
  const Lattice lattice = inside_lattice();
  const Eigen::Matrix3Xd nodes = ball(lattice);
  const Distortion distortion(lattice, nodes);
  // Without distortion the density is 1: the energy equals the volume for every orientation of the ball.
  const double volume = distortion.energy(nodes);
  BOOST_TEST(std::abs(volume / (4.0 / 3.0 * std::numbers::pi) - 1.0) < 0.02);
  const Matrix3 turn = Eigen::AngleAxisd(0.8, Point(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  BOOST_TEST(std::abs(distortion.energy(turn * nodes) / volume - 1.0) < 1e-13);
  const Point stretch(1.5, 0.7, 0.4);
  const double det = stretch.prod();
  const double density = 0.9 * std::pow(stretch.squaredNorm() / 3.0, 1.5) / det + 0.05 * (det + 1.0 / det);
  BOOST_TEST(std::abs(distortion.energy(turn * stretch.asDiagonal() * nodes) / (density * volume) - 1.0) < 1e-12);
  BOOST_TEST(std::abs(distortion.smallest_determinant(stretch.asDiagonal() * nodes) - det) < 1e-12);
  BOOST_TEST(std::isinf(distortion.energy(-nodes)));
}

BOOST_AUTO_TEST_CASE(gradient_is_the_derivative_of_the_energy) {
  const Lattice lattice = inside_lattice();
  const Eigen::Matrix3Xd nodes = ball(lattice);
  const Distortion distortion(lattice, nodes);
  const Eigen::Matrix3Xd x = displaced(nodes, 0.05);
  Eigen::Matrix3Xd direction(3, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) direction.col(i) = wave(Point(2.0 * x.col(i)));
  constexpr double step = 1e-5;
  const double slope =
      (distortion.energy(x + step * direction) - distortion.energy(x - step * direction)) / (2.0 * step);
  BOOST_TEST(std::abs(distortion.gradient(x).cwiseProduct(direction).sum() / slope - 1.0) < 1e-8);
}

// The affine map has the least distortion for its boundary values: displaced nodes return to it.
BOOST_AUTO_TEST_CASE(ball_becomes_an_ellipsoid_by_the_affine_map) {
  const Lattice lattice = inside_lattice();
  const Eigen::Matrix3Xd nodes = ball(lattice);
  const Distortion distortion(lattice, nodes);
  Matrix3 map;
  map << 0.6, 0.1, 0.0, -0.2, 1.4, 0.3, 0.1, 0.0, 1.1;
  const Eigen::Matrix3Xd end = map * nodes;
  Eigen::Matrix3Xd start = displaced(nodes, 0.03);
  for (Eigen::Index i = 0; i < start.cols(); ++i) {
    if (lattice.nodes()[static_cast<std::size_t>(i)].boundary != Lattice::Boundary::none) start.col(i) = nodes.col(i);
  }
  const Eigen::Matrix3Xd found = relaxed_nodes(lattice, distortion, start, [&](double share) -> Eigen::Matrix3Xd {
    return (1.0 - share) * start + share * end;
  });
  BOOST_TEST((found - end).cwiseAbs().maxCoeff() < 1e-2);
  BOOST_TEST(distortion.energy(found) < (1.0 + 1e-5) * distortion.energy(end));
}

BOOST_AUTO_TEST_CASE(boundary_that_collapses_is_an_error_that_says_how_far_it_came) {
  const Lattice lattice = inside_lattice();
  const Eigen::Matrix3Xd nodes = ball(lattice);
  const Distortion distortion(lattice, nodes);
  const auto message = [&] {
    try {
      relaxed_nodes(lattice, distortion, nodes,
                    [&](double share) -> Eigen::Matrix3Xd { return (1.0 - 2.0 * share) * nodes; });
    } catch (const MeshError& error) {
      return std::string(error.what());
    }
    return std::string();
  }();
  BOOST_TEST(message.find("cells collapse at ") != std::string::npos, message);
  BOOST_TEST(message.find("% of the way from a sphere, inside the membrane") != std::string::npos, message);
}

BOOST_AUTO_TEST_SUITE_END()

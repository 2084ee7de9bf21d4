#include "bie/sphere/axis_crossing.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"

using namespace vehd;

namespace {

constexpr int kOrder = 5;

struct Shape {
  SphereGrid grid = make_grid(2 * kOrder);
  Matrix coefficients;
  Matrix nodes;
};

/// A surface given by its map from the unit sphere, of degree ≤ 5.
template <typename Map>
Shape shape_of(Map map) {
  Shape shape;
  const SphereTransform transform(kOrder, shape.grid);
  Matrix values(shape.grid.n_points(), 3);
  for (Index node = 0; node < values.rows(); ++node) {
    values.row(node) = map(direction(point_of(shape.grid, node))).transpose();
  }
  shape.coefficients = transform.analyze(values);
  shape.nodes = transform.synthesize(shape.coefficients);
  return shape;
}

Vector3 place_above(const Vector3& point, const Shape& shape) {
  const SpherePoint at = crossing_above(point, shape.grid, shape.nodes, shape.coefficients);
  return evaluate_harmonics(shape.coefficients, Vector{{at.theta}}, Vector{{at.phi}}).row(0).transpose();
}

const Matrix3 kStretch{{1.2, 0.3, -0.1}, {0.2, 0.8, 0.4}, {-0.3, 0.1, 1.9}};
const Vector3 kCentre{3.0, -1.0, 2.0};

}  // namespace

BOOST_AUTO_TEST_SUITE(axis_crossing)

// M n has the height 1/|M⁻¹ e_z| above its centre.
BOOST_AUTO_TEST_CASE(height_of_an_ellipsoid_above_its_centre_is_exact) {
  const Shape shape = shape_of([](const Vector3& n) { return Vector3(kCentre + kStretch * n); });
  const double height = 1.0 / (kStretch.inverse() * Vector3::UnitZ()).norm();
  BOOST_TEST((place_above(kCentre, shape) - kCentre - height * Vector3::UnitZ()).norm() < 1e-13);
  // Not that of the parameter sphere's pole.
  BOOST_TEST((kStretch * Vector3::UnitZ()).head<2>().norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(place_does_not_depend_on_how_the_surface_is_parametrised) {
  const auto map = [](const Vector3& n) { return Vector3(kStretch * n * (1.0 + 0.3 * n.x() * n.y() * n.z())); };
  const Vector3 place = place_above({0.1, 0.2, -0.1}, shape_of(map));
  BOOST_TEST((place.head<2>() - Eigen::Vector2d(0.1, 0.2)).norm() < 1e-13);
  BOOST_TEST(place.z() > 0.5);
  for (const double angle : {0.4, 1.3, 2.9}) {
    const Matrix3 turn = Eigen::AngleAxisd(angle, Vector3(0.5, -0.7, 0.2).normalized()).toRotationMatrix();
    const Shape turned = shape_of([&](const Vector3& n) { return map(turn * n); });
    BOOST_TEST((place_above({0.1, 0.2, -0.1}, turned) - place).norm() < 1e-12);
  }
}

// Above the surface and beside it no half line crosses.
BOOST_AUTO_TEST_CASE(without_a_crossing_the_answer_is_still_a_point_of_the_surface) {
  const Shape shape = shape_of([](const Vector3& n) { return Vector3(kStretch * n); });
  const Vector3 outside{0.0, 0.0, 5.0};
  BOOST_TEST(place_above(outside, shape).head<2>().norm() < 1e-12);
  const Vector3 aside{5.0, 0.0, 0.0};
  BOOST_TEST(place_above(aside, shape).allFinite());
}

BOOST_AUTO_TEST_SUITE_END()

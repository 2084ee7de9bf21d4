#include "bie/sphere/axis_crossing.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <numbers>
#include <optional>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"
#include "tests/support/fields.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kOrder = 5;

struct Shape {
  SphereGrid grid = make_grid(2 * kOrder);
  Matrix coefficients;
  SphereDerivatives nodes;
};

/// A surface of degree ≤ 5, given by its map from the unit sphere.
template <typename Map>
Shape shape_of(Map map) {
  Shape shape;
  const SphereTransform transform(kOrder, shape.grid);
  Matrix values(shape.grid.n_points(), 3);
  for (Index node = 0; node < values.rows(); ++node) {
    values.row(node) = map(direction(point_of(shape.grid, node))).transpose();
  }
  shape.coefficients = transform.analyze(values);
  shape.nodes = transform.synthesize_hessian(shape.coefficients);
  return shape;
}

std::optional<Vector3> place_on_line(const Vector3& point, const Shape& shape) {
  const auto at = highest_on_line(point, shape.grid, shape.nodes, shape.coefficients);
  if (!at) return std::nullopt;
  return evaluate_harmonics(shape.coefficients, Vector{{at->theta}}, Vector{{at->phi}}).row(0).transpose();
}

Vector3 place_above(const Vector3& point, const Shape& shape) {
  const std::optional<Vector3> place = place_on_line(point, shape);
  BOOST_TEST_REQUIRE(place.has_value());
  return *place;
}

/// Height at which the vertical line through the point meets the triangle, if it does.
std::optional<double> height_on(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& point) {
  Eigen::Matrix2d sides;
  sides << (b - a).head<2>(), (c - a).head<2>();
  if (sides.determinant() == 0.0) return std::nullopt;  // two corners at a pole
  const Eigen::Vector2d shares = sides.inverse() * (point - a).head<2>();
  if (!(shares.minCoeff() >= 0.0) || shares.sum() > 1.0) return std::nullopt;
  return a.z() + shares[0] * (b - a).z() + shares[1] * (c - a).z();
}

/// Highest intersection of the vertical line with a fine polyhedron whose corners lie on the surface.
std::optional<double> height_of_polyhedron(const Vector3& point, const Shape& shape) {
  const SphereTransform transform(kOrder, make_grid(60));
  const SphereGrid& grid = transform.grid();
  const Matrix nodes = transform.synthesize(shape.coefficients);
  const Matrix poles = evaluate_harmonics(shape.coefficients, Vector{{0.0, std::numbers::pi}}, Vector::Zero(2));
  const auto corner = [&](Index row, Index column) -> Vector3 {
    if (row < 0 || row == grid.n_theta) return poles.row(row < 0 ? 0 : 1).transpose();
    return nodes.row(row * grid.n_phi + column % grid.n_phi).transpose();
  };
  std::optional<double> highest;
  for (Index row = -1; row < grid.n_theta; ++row) {
    for (Index column = 0; column < grid.n_phi; ++column) {
      const Vector3 a = corner(row, column), b = corner(row, column + 1), c = corner(row + 1, column),
                    d = corner(row + 1, column + 1);
      for (const auto& height : {height_on(a, b, c, point), height_on(b, c, d, point)}) {
        if (height) highest = std::max(*height, highest.value_or(*height));
      }
    }
  }
  return highest;
}

const Matrix3 kStretch{{1.2, 0.3, -0.1}, {0.2, 0.8, 0.4}, {-0.3, 0.1, 1.9}};
const Vector3 kCentre{3.0, -1.0, 2.0};

}  // namespace

BOOST_AUTO_TEST_SUITE(axis_crossing)

// The surface M n has the height 1/|M⁻¹ e_z| above its centre.
BOOST_AUTO_TEST_CASE(height_of_an_ellipsoid_above_its_centre_is_exact) {
  const Shape shape = shape_of([](const Vector3& n) { return Vector3(kCentre + kStretch * n); });
  const double height = 1.0 / (kStretch.inverse() * Vector3::UnitZ()).norm();
  BOOST_TEST((place_above(kCentre, shape) - kCentre - height * Vector3::UnitZ()).norm() < 1e-13);
  // The crossing is not the image of the parameter sphere's pole.
  BOOST_TEST((kStretch * Vector3::UnitZ()).head<2>().norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(place_does_not_depend_on_how_the_surface_is_parametrised) {
  const auto map = [](const Vector3& n) { return Vector3(kStretch * n * (1.0 + 0.3 * n.x() * n.y() * n.z())); };
  const Vector3 place = place_above({0.1, 0.2, -0.1}, shape_of(map));
  BOOST_TEST((place.head<2>() - Eigen::Vector2d(0.1, 0.2)).norm() < 1e-13);
  BOOST_TEST(place.z() > 0.5);
  for (const double angle : {0.4, 1.3, 2.9}) {
    const Matrix3 turn = Eigen::AngleAxisd(angle, Vector3(0.5, -0.7, 0.2).normalized()).toRotationMatrix();
    const Shape rotated = shape_of([&](const Vector3& n) { return map(turn * n); });
    BOOST_TEST((place_above({0.1, 0.2, -0.1}, rotated) - place).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(point_may_lie_anywhere_on_the_line_and_beside_the_surface_there_is_nothing) {
  const Shape shape = shape_of([](const Vector3& n) { return Vector3(kStretch * n); });
  const Vector3 place = place_above({0.1, 0.2, 0.0}, shape);
  for (const double z : {-50.0, -1.0, 1.0, 50.0})
    BOOST_TEST((place_above({0.1, 0.2, z}, shape) - place).norm() < 1e-13);
  BOOST_TEST(!place_on_line({5.0, 0.0, 0.0}, shape));
  BOOST_TEST(!place_on_line({-1.3, 0.0, 0.0}, shape));
}

// Folded surfaces that lines intersect several times, some of them with arbitrary parametrisation poles.
BOOST_AUTO_TEST_CASE(no_crossing_of_a_random_surface_lies_higher) {
  int n_crossed = 0, n_missed = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Shape shape = shape_of([](const Vector3& n) { return n; });
    shape.coefficients += 0.25 * random_coefficients(kOrder, 3, seed);
    const SphereTransform transform(kOrder, shape.grid);
    shape.nodes = transform.synthesize_hessian(shape.coefficients);
    const Matrix lines = random_coefficients(3, 3, 1000 + seed);
    for (Index line = 0; line < lines.rows(); ++line) {
      const Vector3 point = lines.row(line).transpose();
      const std::optional<double> expected = height_of_polyhedron(point, shape);
      const std::optional<Vector3> place = place_on_line(point, shape);
      ++(expected ? n_crossed : n_missed);
      BOOST_TEST(place.has_value() == expected.has_value(), "seed " << seed << ", line " << line << ": "
                                                                    << (place ? place->z() : NAN) << " and not "
                                                                    << expected.value_or(NAN));
      if (!place || !expected) continue;
      BOOST_TEST((*place - point).head<2>().norm() < 1e-10);
      // A corner of the polyhedron can lie below the surface by the sagitta of its sides.
      BOOST_TEST(place->z() > *expected - 0.02,
                 "seed " << seed << ", line " << line << ": " << place->z() << " and not " << *expected);
    }
  }
  BOOST_TEST(n_crossed > 100);
  BOOST_TEST(n_missed > 100);
}

BOOST_AUTO_TEST_CASE(size_and_place_of_the_surface_do_not_matter) {
  const auto map = [](const Vector3& n) { return Vector3(kStretch * n * (1.0 + 0.4 * n.x() * n.y() * n.z())); };
  const Vector3 point{0.1, 0.2, -0.1};
  const Vector3 place = place_above(point, shape_of(map));
  for (const double size : {1e-9, 1e-3, 1e6}) {
    const Vector3 moved = place_above(size * (point + kCentre),
                                      shape_of([&](const Vector3& n) -> Vector3 { return size * (map(n) + kCentre); }));
    BOOST_TEST((moved / size - kCentre - place).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(of_the_poles_of_an_axisymmetric_surface_the_higher_one_counts) {
  // Both poles of a bowl have normals in the same direction.
  const Shape opens_downwards = shape_of([](const Vector3& n) -> Vector3 {
    return {n.x(), n.y(), 0.2 * n.z() + 1.0 - n.head<2>().squaredNorm()};
  });
  BOOST_TEST(higher_pole(opens_downwards.coefficients).theta == 0.0);
  const Shape opens_upwards = shape_of([](const Vector3& n) -> Vector3 {
    return {n.x(), n.y(), -0.2 * n.z() - 1.0 + n.head<2>().squaredNorm()};
  });
  BOOST_TEST(higher_pole(opens_upwards.coefficients).theta == std::numbers::pi);
  for (const Shape* shape : {&opens_downwards, &opens_upwards}) {
    const SpherePoint pole = higher_pole(shape->coefficients);
    const Vector3 expected =
        evaluate_harmonics(shape->coefficients, Vector{{pole.theta}}, Vector{{pole.phi}}).row(0).transpose();
    BOOST_TEST((place_above(Vector3::Zero(), *shape) - expected).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_SUITE_END()

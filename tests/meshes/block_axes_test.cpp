#include "meshes/block_axes.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "meshes/mesh_quality.hpp"
#include "tests/meshes/mesh_checks.hpp"
#include "tests/meshes/shapes.hpp"

using namespace vehd::meshes;
using namespace vehd::meshes::testing;

namespace {

Matrix3 turn_about_z(double degrees) {
  return Eigen::AngleAxisd(degrees / 180.0 * std::numbers::pi, Point::UnitZ()).toRotationMatrix();
}

/// Smallest rotation angle in degrees between two cubes, up to the symmetries of a cube.
double angle_between_cubes(const Matrix3& a, const Matrix3& b) {
  double best = 180.0;
  for (int first = 0; first < 3; ++first) {
    for (int second = 0; second < 3; ++second) {
      if (second == first) continue;
      for (const double s : {-1.0, 1.0}) {
        for (const double t : {-1.0, 1.0}) {
          Matrix3 symmetry;
          symmetry.col(0) = s * Point::Unit(first);
          symmetry.col(1) = t * Point::Unit(second);
          symmetry.col(2) = symmetry.col(0).cross(symmetry.col(1));
          const double angle = Eigen::AngleAxisd(Matrix3(a.transpose() * b * symmetry)).angle();
          best = std::min(best, angle * 180.0 / std::numbers::pi);
        }
      }
    }
  }
  return best;
}

/// Shape (33) with rotated surface coordinates, x(Qᵀ r̂). The surface itself is unchanged.
FrozenShape carried_33(const Matrix3& turn) {
  const FrozenShape shape = shape_33();
  return FrozenShape(project(16, [&](const Point& r) { return shape.position(turn.transpose() * r); }));
}

/// Shape (33) stretched along an axis, so that only rotations about that axis remain free.
FrozenShape stretched_33(double factor) {
  const FrozenShape shape = shape_33();
  return FrozenShape(
      project(16, [&](const Point& r) { return Point(shape.position(r).cwiseProduct(Point(1.0, 1.0, factor))); }));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(block_axes)

BOOST_AUTO_TEST_CASE(truncation_error_is_the_highest_legendre_mode_of_the_faces) {
  // Each face of the sphere alone: the error falls with the degree that a finer set of faces resolves, and turns of the
  // whole parametrisation do not touch it.
  const FrozenShape sphere = off_centre_sphere();
  const double error = truncation_error(sphere, Matrix3::Identity());
  BOOST_TEST(error > 1e-8);
  BOOST_TEST(error < 1e-6);
  BOOST_TEST(std::abs(truncation_error(sphere, general_rotation()) / error - 1.0) < 1e-6);
  // Rotating the directions and the cube together has no effect.
  const double rotated = truncation_error(carried_33(general_rotation()), general_rotation());
  BOOST_TEST(std::abs(rotated / truncation_error(shape_33(), Matrix3::Identity()) - 1.0) < 1e-9);
}

BOOST_AUTO_TEST_CASE(strongly_bent_shapes_take_more_cells) {
  const auto ellipsoid = [](double a, double b, double c) {
    return FrozenShape(project(1, [&](const Point& r) { return Point(a * r.x(), b * r.y(), c * r.z()); }));
  };
  BOOST_TEST(!is_strongly_bent(off_centre_sphere(), 3));
  BOOST_TEST(!is_strongly_bent(ellipsoid(1.0, 1.15, 1.3), 3));
  BOOST_TEST(!is_strongly_bent(shape_33(), 3));
  BOOST_TEST(is_strongly_bent(ellipsoid(1.0, 1.0, 5.0), 3));
  BOOST_TEST(is_strongly_bent(ellipsoid(1.0, 1.0, 0.2), 3));
  BOOST_TEST(!is_strongly_bent(ellipsoid(1.0, 1.0, 5.0), 6));
  BOOST_TEST(!is_strongly_bent(ellipsoid(1.0, 1.0, 0.2), 6));
  // The ends lie in the middle of a cell, or on a corner of four.
  const FrozenShape needle = ellipsoid(1.0, 1.0, 5.0);
  BOOST_TEST(normal_truncation_error(needle, Matrix3::Identity(), 4) <
             0.2 * normal_truncation_error(needle, Matrix3::Identity(), 3));
}

BOOST_AUTO_TEST_CASE(corners_of_the_cube_lie_on_the_bumps_of_shape_33) {
  // Y_3^2 rotated by 45 degrees about z is proportional to xyz, whose extremes are the corners of the cube.
  const BlockAxes axes = best_axes(shape_33());
  BOOST_TEST(angle_between_cubes(axes.in_directions, turn_about_z(45.0)) < 1.0);
  BOOST_TEST((axes.in_space - axes.in_directions).cwiseAbs().maxCoeff() < 1e-12);
  const double gain =
      truncation_error(shape_33(), Matrix3::Identity()) / truncation_error(shape_33(), axes.in_directions);
  BOOST_TEST(gain > 1.5);
  BOOST_TEST(gain < 1.55);
}

BOOST_AUTO_TEST_CASE(best_axes_are_found_wherever_they_are) {
  const double best = truncation_error(shape_33(), turn_about_z(45.0));
  for (const Matrix3& turn : {general_rotation(), Matrix3(general_rotation() * general_rotation()),
                              Matrix3(turn_about_z(20.0)), Matrix3(turn_about_z(45.0))}) {
    const FrozenShape shape = carried_33(turn);
    const BlockAxes axes = best_axes(shape);
    BOOST_TEST(truncation_error(shape, axes.in_directions) < 1.01 * best);
    BOOST_TEST(angle_between_cubes(axes.in_directions, turn * turn_about_z(45.0)) < 2.0);
    // Blocks follow the surface in space: U carries the cube along with x.
    BOOST_TEST(angle_between_cubes(axes.in_space, turn_about_z(45.0)) < 2.0);
  }
}

BOOST_AUTO_TEST_CASE(principal_axes_stay_where_no_turn_gains) {
  for (const FrozenShape& shape :
       {off_centre_sphere(), prolate(), disc(), rotated_disc(), carried_33(turn_about_z(45.0))}) {
    const BlockAxes best = best_axes(shape), principal = principal_axes(shape);
    BOOST_TEST((best.in_directions - principal.in_directions).norm() == 0.0);
    BOOST_TEST((best.in_space - principal.in_space).norm() == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(marked_axes_are_kept) {
  // With two equal stretches rotations about the third axis remain free; with three different ones none do.
  const BlockAxes stretched = best_axes(stretched_33(1.5));
  BOOST_TEST((stretched.in_directions.col(2) - Point::UnitZ()).norm() < 1e-9);
  BOOST_TEST(angle_between_cubes(stretched.in_directions, turn_about_z(45.0)) < 3.0);
  const FrozenShape shape = asymmetric();
  BOOST_TEST((best_axes(shape).in_directions - principal_axes(shape).in_directions).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(two_searches_end_at_the_same_axes) {
  const BlockAxes a = best_axes(shape_33()), b = best_axes(shape_33());
  BOOST_TEST((a.in_directions - b.in_directions).norm() == 0.0);
  BOOST_TEST((a.in_space - b.in_space).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(rotated_blocks_are_as_well_formed) {
  BlockMeshOptions options;
  options.cells_per_edge = 3;
  options.blend_layers = 1;
  for (const FrozenShape& shape : {shape_33(), carried_33(general_rotation()), stretched_33(1.5)}) {
    const HexMesh mesh = make_block_mesh(shape, options);
    BOOST_TEST(quality(mesh, shape).smallest_scaled_jacobian > 0.3);
    const SheetGaps gaps = sheet_gaps(mesh, shape);
    BOOST_TEST(gaps.off_shape < 1e-13);
    BOOST_TEST(gaps.direction < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()

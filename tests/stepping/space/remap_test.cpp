#include "bie/stepping/space/remap.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/physics/effects/bending.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

struct Tables {
  SphereTransform fine;
  explicit Tables(int order) : fine(order, make_grid(2 * order)) {}

  [[nodiscard]] Surface surface(const Matrix& position) const { return make_surface(fine, position); }
  /// x after one remap that follows the given displacement.
  [[nodiscard]] Matrix moved(const Matrix& position, const Matrix& displacement, const Matrix& fields) const {
    SurfaceFields material;
    material.position = position;
    if (fields.cols() > 3) material.tension = fields.col(3);
    const SurfaceFields after = remap(fine, displacement, material);
    Matrix result = fields;
    result.leftCols(3) = after.position;
    if (fields.cols() > 3) result.col(3) = after.tension;
    return result;
  }
};

/// A displacement of a typical step: a few percent of the size.
Matrix displacement(int order) { return 0.02 * smooth_coefficients(order, 3, 3, 111); }

struct Changes {
  double area, volume, energy;
};

Changes changes(int order, const Matrix& position) {
  const Tables tables(order);
  const Surface before = tables.surface(position);
  const Surface after = tables.surface(tables.moved(position, displacement(order), position));
  return {std::abs(surface_area(after) / surface_area(before) - 1.0),
          std::abs(enclosed_volume(after) / enclosed_volume(before) - 1.0),
          std::abs(bending_energy_scaled(after) / bending_energy_scaled(before) - 1.0)};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(remap)

BOOST_AUTO_TEST_CASE(round_sphere_at_rest_stays_as_it_is) {
  const Tables tables(12);
  const Matrix position = translated(sphere(12, 1.4), {0.2, 0.1, -0.3});
  BOOST_TEST(max_difference(tables.moved(position, Matrix::Zero(position.rows(), 3), position), position) < 1e-13);
}

BOOST_AUTO_TEST_CASE(surface_keeps_area_volume_and_energy_to_truncation) {
  const Changes coarse = changes(12, asymmetric_shape(12));
  const Changes fine = changes(32, asymmetric_shape(32));
  BOOST_TEST(fine.area < 1e-3 * coarse.area);
  BOOST_TEST(fine.volume < 1e-3 * coarse.volume);
  BOOST_TEST(fine.energy < 1e-3 * coarse.energy);
  BOOST_TEST(fine.area < 1e-11);
  BOOST_TEST(fine.volume < 1e-12);
  BOOST_TEST(fine.energy < 1e-8);
}

BOOST_AUTO_TEST_CASE(new_nodes_lie_on_the_old_surface) {
  // The implicit equation of the ellipsoid gives the distance of every node, to first order.
  const Vector3 axes(1.0, 1.2, 2.0);
  const Tables tables(24);
  const Matrix position = ellipsoid(24, axes);
  const Matrix nodes = tables.fine.synthesize(tables.moved(position, displacement(24), position));
  const Matrix scaled = nodes * axes.cwiseInverse().asDiagonal();
  BOOST_TEST((nodes - tables.surface(position).position).cwiseAbs().maxCoeff() > 1e-3);
  BOOST_TEST((scaled.rowwise().squaredNorm().array() - 1.0).abs().maxCoeff() < 1e-7);
}

BOOST_AUTO_TEST_CASE(fields_ride_on_their_material_points) {
  // A function of the position in space is the same function of the new nodes.
  const int order = 24;
  const Tables tables(order);
  const Matrix position = asymmetric_shape(order);
  const Vector3 a(0.4, -0.7, 0.2);
  const auto of_place = [&](const Matrix& x) -> Vector { return (x * a).array() + (x * a).array().square(); };
  Matrix fields(position.rows(), 4);
  fields << position, tables.fine.analyze(of_place(tables.surface(position).position));
  const Matrix carried = tables.fine.synthesize(tables.moved(position, displacement(order), fields));
  BOOST_TEST(max_difference(carried.col(3), of_place(carried.leftCols(3))) < 1e-6);
}

BOOST_AUTO_TEST_CASE(sliding_of_the_last_step_is_undone) {
  // A sphere that rotated about its centre: its nodes return to their positions, to second order in the angle.
  const int order = 12;
  const Tables tables(order);
  const Matrix position = sphere(order);
  const auto error = [&](double angle) {
    const Matrix3 turn = Eigen::AngleAxisd(angle, Vector3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    const Matrix rotated = position * turn.transpose();
    return max_difference(tables.moved(rotated, rotated - position, rotated), position);
  };
  BOOST_TEST(error(0.02) < 1e-3);
  BOOST_TEST(error(0.02) < 0.3 * error(0.04));
}

BOOST_AUTO_TEST_CASE(translation_is_no_sliding_of_the_whole_grid) {
  // Only the tangential part that keeps area elements is undone; a sphere that moved along z stays there.
  const int order = 12;
  const Tables tables(order);
  const Matrix moved = translated(sphere(order), {0.0, 0.0, 0.05});
  const Matrix after = tables.moved(moved, moved - sphere(order), moved);
  BOOST_TEST(max_difference(after, moved) < 1e-12);
}

BOOST_AUTO_TEST_CASE(repetition_lowers_the_high_degrees_of_a_distorted_grid) {
  // A prolate whose nodes were pushed along the surface has high degrees that another grid does not need.
  const int order = 16;
  const Tables tables(order);
  Vector push = Vector::Zero(n_coefficients(order));
  push[coefficient_index(9, 5)] = 0.004;
  const SphereDerivatives d = tables.fine.synthesize_gradient(push);
  const GridAngles angles = grid_angles(tables.fine.grid());
  const Vector phi = angles.phi.array() + d.d2.col(0).array() / angles.theta.array().sin();
  Matrix position = tables.fine.analyze(evaluate_harmonics(prolate(order), angles.theta + d.d1.col(0), phi));
  const auto high_degrees = [](const Matrix& x) { return x.bottomRows(x.rows() - n_coefficients(6)).norm(); };
  const double before = high_degrees(position);
  double last = before;
  for (int i = 0; i < 20; ++i) {
    position = tables.moved(position, Matrix::Zero(position.rows(), 3), position);
    BOOST_TEST(high_degrees(position) < last);
    last = high_degrees(position);
  }
  BOOST_TEST(last < 0.5 * before);
}

BOOST_AUTO_TEST_SUITE_END()

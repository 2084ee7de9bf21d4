#include "bie/potentials/pair_layers.hpp"

#include <omp.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "bie/support/errors.hpp"
#include "tests/potentials/off_surface_fields.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/targets.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(pair_layers)

namespace {

constexpr PairSelection kEveryLayer{true, true, true, true, true, true};
const std::vector<double> kGaps = {1e-3, 1e-2, 0.1, 0.3, 0.6, 1.0, 3.0, 10.0};

/// Arbitrary unit vectors, not normals of a surface.
Matrix any_normals(Index n) {
  Matrix normals(n, 3);
  for (Index i = 0; i < n; ++i) {
    normals.row(i) = Vector3(std::sin(1.0 + i), std::cos(2.0 * i), std::sin(0.3 * i * i)).normalized().transpose();
  }
  return normals;
}

PairLayers pair_layers(const Matrix& source, const Matrix& points, const Matrix& normals) {
  Instruments instruments;
  SharedTransforms transforms;
  return {source, points, normals, kEveryLayer, {}, transforms, instruments};
}

/// Points at all gaps of kGaps from the membrane.
Matrix points_at_all_gaps(const Matrix& position, int n) {
  const MembranePoints points = membrane_points(position, scattered_angles(n));
  Matrix all(0, 3);
  for (const double gap : kGaps) {
    const Matrix more = points.at_height(gap);
    all.conservativeResize(all.rows() + more.rows(), 3);
    all.bottomRows(more.rows()) = more;
  }
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(layers_of_harmonics_on_a_sphere_are_exact_at_every_gap) {
  constexpr int kOrder = 12;
  const double radius = 1.3;
  const Matrix position = sphere(kOrder, radius);
  const GridAngles angles = scattered_angles(12);
  const MembranePoints around = membrane_points(position, angles);
  for (const double gap : kGaps) {
    const Matrix points = around.at_height(gap);
    const Matrix normals = any_normals(points.rows());
    const PairLayers layers = pair_layers(position, points, normals);
    for (const auto& [n, m] : {std::pair{0, 0}, {1, -1}, {4, 3}, {12, -5}}) {
      const Vector y = harmonic(kOrder, n, m);
      const Vector weighted = radius * radius * y;
      const Vector single = layers.apply(PairLayer::laplace_single, weighted),
                   flux = layers.apply(PairLayer::laplace_single_normal, weighted);
      const Vector double_layer = layers.apply(PairLayer::laplace_double, y),
                   double_flux = layers.apply(PairLayer::laplace_double_normal, y);
      double error = 0.0;
      for (Index i = 0; i < points.rows(); ++i) {
        const double r = radius + gap;
        const Vector3 normal = normals.row(i).transpose();
        const auto exact = [&](const Radial& g) { return solid_harmonic(y, g, r, angles.theta[i], angles.phi[i]); };
        const ScalarAndGradient s = exact(single_of_sphere(n, radius, r, false));
        const ScalarAndGradient d = exact(double_of_sphere(n, radius, r, false));
        error = std::max({error, std::abs(single[i] - s.value), std::abs(flux[i] - s.gradient.dot(normal)),
                          std::abs(double_layer[i] - d.value),
                          std::abs(double_flux[i] - d.gradient.dot(normal)) / (n + 1.0)});
      }
      BOOST_TEST(error < 1e-9, "degree " << n << " gap " << gap << " error " << error);
    }
  }
}

BOOST_AUTO_TEST_CASE(stokes_layers_of_rigid_motions_of_a_sphere_are_exact_at_every_gap) {
  const double radius = 1.3;
  const Matrix position = sphere(12, radius);
  const Matrix points = points_at_all_gaps(position, 12);
  const PairLayers layers = pair_layers(position, points, any_normals(points.rows()));
  const Vector3 force(0.3, -0.8, 0.5), rotation(-0.4, 0.9, 0.2);
  Matrix weighted = Matrix::Zero(position.rows(), 3);
  weighted.row(0) = force.transpose() / std::sqrt(4.0 * std::numbers::pi);
  Matrix motion(position.rows(), 3);
  for (Index i = 0; i < motion.rows(); ++i) {
    motion.row(i) = rotation.cross(Vector3(position.row(i).transpose())).transpose();
  }
  motion.row(0) += std::sqrt(4.0 * std::numbers::pi) * force.transpose();
  const Matrix found = layers.apply(PairLayer::stokes_single, weighted);
  for (Index i = 0; i < points.rows(); ++i) {
    // F·[(I + r̂r̂)/r + R²(I − 3r̂r̂)/(3r³)]/(8π)
    const Vector3 x = points.row(i).transpose();
    const double r = x.norm();
    const Vector3 n = x / r;
    const Vector3 exact =
        ((force + n.dot(force) * n) / r + radius * radius / (3.0 * r * r * r) * (force - 3.0 * n.dot(force) * n)) /
        (8.0 * std::numbers::pi);
    BOOST_TEST((found.row(i).transpose() - exact).norm() < 1e-10);
  }
  BOOST_TEST(layers.apply(PairLayer::stokes_double, motion).cwiseAbs().maxCoeff() < 1e-9);
}

// Shapes without symmetry, densities up to the degree of the membrane; off-surface evaluation is independent code.
BOOST_AUTO_TEST_CASE(layers_of_given_densities_agree_with_those_off_the_membrane) {
  for (const int order : {12, 16}) {
    const Matrix position = asymmetric_shape(order);
    const Matrix points = points_at_all_gaps(position, 9);
    const Matrix normals = any_normals(points.rows());
    const PairLayers layers = pair_layers(position, points, normals);
    BOOST_TEST(layers.counts().near > 0);
    BOOST_TEST(layers.counts().far > 0);
    BOOST_TEST(layers.counts().near + layers.counts().far == points.rows());
    LayerDensities densities = all_densities(order);
    densities.laplace_double += smooth_coefficients(order, order, 1, 65);
    Instruments instruments;
    const OffSurfaceValues v = OffSurfaceLayers(position, densities, {.tolerance = 1e-11, .max_rules = 14})
                                   .evaluate(points, Side::exterior, instruments);
    require_resolved(v, points);
    const auto along = [&normals](const Matrix& gradient) -> Vector {
      return gradient.cwiseProduct(normals).rowwise().sum();
    };
    BOOST_TEST(max_difference(layers.apply(PairLayer::laplace_single, densities.laplace_single),
                              v.laplace_single.values) < 1e-9);
    BOOST_TEST(max_difference(layers.apply(PairLayer::laplace_single_normal, densities.laplace_single),
                              along(v.laplace_single_gradient.values)) < 1e-9);
    BOOST_TEST(max_difference(layers.apply(PairLayer::laplace_double, densities.laplace_double),
                              v.laplace_double.values) < 1e-9);
    const double steepest = along(v.laplace_double_gradient.values).cwiseAbs().maxCoeff();
    BOOST_TEST(max_difference(layers.apply(PairLayer::laplace_double_normal, densities.laplace_double),
                              along(v.laplace_double_gradient.values)) < 1e-9 * std::max(1.0, steepest));
    BOOST_TEST(max_difference(layers.apply(PairLayer::stokes_single, densities.stokes_single), v.stokes_single.values) <
               1e-9);
    BOOST_TEST(max_difference(layers.apply(PairLayer::stokes_double, densities.stokes_double), v.stokes_double.values) <
               1e-9);
  }
}

// Outside shape (33), which encloses the source, φ = D[φ] − S[∂φ/∂n]; the gradient satisfies the same identity.
BOOST_AUTO_TEST_CASE(sources_within_shape_33_are_seen_at_every_gap) {
  constexpr int kOrder = 24;
  const PointField field(kOrder, shape_33(kOrder), {0.1, -0.05, 0.15}, {9.0, 0.0, 0.0});
  const PointPotential source = point_potential(field.surface, field.inner);
  const Vector value = field.space.fine.analyze(source.value), flux = weighted(field.space, field.surface, source.flux);
  const Matrix points = points_at_all_gaps(field.position, 9);
  const Matrix normals = any_normals(points.rows());
  const PairLayers layers = pair_layers(field.position, points, normals);
  const Vector found = layers.apply(PairLayer::laplace_double, value) - layers.apply(PairLayer::laplace_single, flux);
  const Vector slope =
      layers.apply(PairLayer::laplace_double_normal, value) - layers.apply(PairLayer::laplace_single_normal, flux);
  double error = 0.0, slope_error = 0.0;
  for (Index i = 0; i < points.rows(); ++i) {
    const Vector3 r = points.row(i).transpose() - field.inner;
    const double exact = kLaplacePrefactor / r.norm();
    error = std::max(error, std::abs(found[i] - exact));
    slope_error = std::max(slope_error, std::abs(slope[i] + exact / r.squaredNorm() * r.dot(normals.row(i))));
  }
  // Truncation of the traces to degree 24 limits the accuracy.
  BOOST_TEST(error < 1e-9);
  BOOST_TEST(slope_error < 2e-8);
}

BOOST_AUTO_TEST_CASE(rows_of_far_targets_are_the_sums_of_their_rule) {
  const Matrix position = asymmetric_shape(8);
  const Matrix points = points_at_all_gaps(position, 7);
  const Matrix normals = any_normals(points.rows());
  const PairLayers rows = pair_layers(position, points, normals);
  const Vector density = smooth_coefficients(8, 8, 1, 67);
  const Matrix vectors = smooth_coefficients(8, 8, 3, 68);
  // Memory for no grid, for some grids and for all grids.
  for (const double bytes : {0.0, 3e5, 1e9}) {
    Instruments instruments;
    SharedTransforms transforms;
    const PairLayers sums(position, points, normals, kEveryLayer, {.row_bytes = bytes}, transforms, instruments);
    BOOST_TEST(max_difference(rows.apply(PairLayer::laplace_single, density),
                              sums.apply(PairLayer::laplace_single, density)) < 1e-13);
    BOOST_TEST(max_difference(rows.apply(PairLayer::laplace_single_normal, density),
                              sums.apply(PairLayer::laplace_single_normal, density)) < 1e-13);
    BOOST_TEST(max_difference(rows.apply(PairLayer::laplace_double, density),
                              sums.apply(PairLayer::laplace_double, density)) < 1e-13);
    BOOST_TEST(max_difference(rows.apply(PairLayer::laplace_double_normal, density),
                              sums.apply(PairLayer::laplace_double_normal, density)) < 1e-13);
    BOOST_TEST(max_difference(rows.apply(PairLayer::stokes_single, vectors),
                              sums.apply(PairLayer::stokes_single, vectors)) < 1e-13);
    BOOST_TEST(max_difference(rows.apply(PairLayer::stokes_double, vectors),
                              sums.apply(PairLayer::stokes_double, vectors)) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(threads_change_no_bit) {
  const Matrix position = asymmetric_shape(8);
  const Matrix points = points_at_all_gaps(position, 5);
  const Matrix density = smooth_coefficients(8, 6, 3, 66);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Matrix serial =
      pair_layers(position, points, any_normals(points.rows())).apply(PairLayer::stokes_double, density);
  omp_set_num_threads(3);
  const Matrix parallel =
      pair_layers(position, points, any_normals(points.rows())).apply(PairLayer::stokes_double, density);
  omp_set_num_threads(threads);
  BOOST_TEST(max_difference(serial, parallel) == 0.0);
}

BOOST_AUTO_TEST_CASE(targets_inside_are_refused) {
  const Matrix position = asymmetric_shape(8);
  const MembranePoints points = membrane_points(position, scattered_angles(3));
  for (const double depth : {-1e-3, -0.1}) {
    const Matrix inside = points.at_height(depth);
    BOOST_CHECK_THROW(pair_layers(position, inside, any_normals(inside.rows())), ConvergenceError);
  }
}

BOOST_AUTO_TEST_CASE(layers_that_were_not_selected_are_refused) {
  Instruments instruments;
  SharedTransforms transforms;
  const Matrix points = points_at_all_gaps(sphere(6), 2);
  const PairLayers layers(sphere(6), points, any_normals(points.rows()), {.laplace_single = true}, {}, transforms,
                          instruments);
  BOOST_CHECK_THROW((void)layers.apply(PairLayer::laplace_double, harmonic(6, 1, 0)), std::logic_error);
  BOOST_CHECK_THROW((void)layers.apply(PairLayer::stokes_single, Matrix::Zero(49, 3)), std::logic_error);
}

BOOST_AUTO_TEST_SUITE_END()

#include <omp.h>

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/potentials/off_surface.hpp"
#include "bie/support/errors.hpp"
#include "tests/potentials/off_surface_fields.hpp"
#include "tests/support/layers.hpp"
#include "tests/support/point_potential.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/targets.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(off_surface)

BOOST_AUTO_TEST_CASE(pressure_density_moves_no_fluid_inside_or_outside) {
  const Space space(16);
  const Matrix position = asymmetric_shape(16);
  const Surface surface = make_surface(space.fine, position);
  LayerDensities densities;
  densities.stokes_single = weighted(space, surface, surface.normal);
  const OffSurfaceLayers layers(position, densities);
  const MembranePoints points = membrane_points(position, scattered_angles(20));
  for (const double height : heights(0.2)) {
    const OffSurfaceValues v = evaluate(layers, points.at_height(height));
    BOOST_TEST(v.stokes_single.values.cwiseAbs().maxCoeff() < 1e-9, "height " << height);
  }
}

BOOST_AUTO_TEST_CASE(estimate_bounds_the_error) {
  // For a smooth density on a sphere the true error is the quadrature error.
  constexpr int kOrder = 12;
  const Matrix position = sphere(kOrder);
  const Vector y = harmonic(kOrder, 5, 2);
  LayerDensities densities;
  densities.laplace_single = y;
  OffSurfaceSettings settings;
  settings.tolerance = 1e-3;
  const OffSurfaceLayers layers(position, densities, settings);
  const GridAngles angles = scattered_angles(30);
  const MembranePoints points = membrane_points(position, angles);
  for (const double height : {-0.3, -1e-2, -1e-5, 1e-5, 1e-2, 0.3}) {
    const OffSurfaceValues v = evaluate(layers, points.at_height(height));
    for (Index i = 0; i < angles.theta.size(); ++i) {
      const double r = 1.0 + height;
      const double exact =
          solid_harmonic(y, single_of_sphere(5, 1.0, r, height < 0.0), r, angles.theta[i], angles.phi[i]).value;
      BOOST_TEST(std::abs(v.laplace_single.values(i) - exact) <= v.laplace_single.error[i] + 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(sheets_closer_than_the_nodes_are_separated) {
  // A disc of half thickness t with the grid poles off its axis: nodes of one sheet face gaps of the other.
  constexpr int kOrder = 16;
  const double t = 0.01;
  LayerDensities densities;
  densities.laplace_double = smooth_coefficients(kOrder, 4, 1, 64);
  OffSurfaceSettings settings;
  settings.max_rules = 2;
  const Matrix disc = move_poles(ellipsoid(kOrder, {1.0, 1.0, t}), general_rotation());
  const OffSurfaceLayers layers(disc, densities, settings);
  Instruments instruments;
  for (const double height : {-0.8, 0.3, 1.2, 2.0, -1.5}) {
    Matrix points(50, 3);
    for (Index i = 0; i < points.rows(); ++i) {
      const double rho = 0.8 * std::sqrt((i + 0.5) / points.rows());
      points.row(i) << rho * std::cos(2.4 * i), rho * std::sin(2.4 * i), height * t * std::sqrt(1.0 - rho * rho);
    }
    const OffSurfaceValues v = layers.evaluate(points, Side::principal_value, instruments);
    const Side expected = std::abs(height) < 1.0 ? Side::interior : Side::exterior;
    BOOST_TEST(std::count(v.side.begin(), v.side.end(), expected) == points.rows(), "height " << height);
  }
}

BOOST_AUTO_TEST_CASE(unresolved_targets_are_reported) {
  constexpr int kOrder = 16;
  const double t = 0.01;
  LayerDensities densities;
  densities.laplace_double = smooth_coefficients(kOrder, 4, 1, 64);
  const OffSurfaceLayers layers(ellipsoid(kOrder, {1.0, 1.0, t}), densities);
  Matrix points(2, 3);
  points << 0.3, 0.0, 0.5 * t, 2.0, 1.0, 1.0;
  Instruments instruments;
  const OffSurfaceValues v = layers.evaluate(points, Side::interior, instruments);
  BOOST_TEST(!v.resolved[0]);
  BOOST_TEST(v.laplace_double.error[0] > 1e-9);
  BOOST_TEST(v.resolved[1]);
  BOOST_CHECK_THROW(require_resolved(v, points), ConvergenceError);
}

BOOST_AUTO_TEST_CASE(threads_change_no_bit_and_every_kernel_is_counted) {
  const Matrix position = asymmetric_shape(12);
  const OffSurfaceLayers layers(position, all_densities(12));
  Matrix points(36, 3);
  const MembranePoints on_membrane = membrane_points(position, scattered_angles(9));
  points << on_membrane.at_height(0.01), on_membrane.at_height(-0.1), on_membrane.at_height(1.0);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  Instruments one;
  const OffSurfaceValues serial = layers.evaluate(points, Side::interior, one);
  omp_set_num_threads(3);
  Instruments three;
  const OffSurfaceValues parallel = layers.evaluate(points, Side::interior, three);
  omp_set_num_threads(threads);
  BOOST_TEST(max_difference(serial.laplace_double.values, parallel.laplace_double.values) == 0.0);
  BOOST_TEST(max_difference(serial.stokes_single.values, parallel.stokes_single.values) == 0.0);
  BOOST_TEST(max_difference(serial.stokes_double.values, parallel.stokes_double.values) == 0.0);
  BOOST_TEST(max_difference(serial.laplace_double_gradient.values, parallel.laplace_double_gradient.values) == 0.0);
  for (const char* kernel : {"laplace_single", "laplace_single_gradient", "laplace_double", "laplace_double_gradient",
                             "stokes_single", "stokes_double"}) {
    BOOST_TEST(one.kernel_evaluations().at(kernel) > 36u * 1000u);
    BOOST_TEST(one.kernel_evaluations().at(kernel) == three.kernel_evaluations().at(kernel));
  }
  BOOST_TEST(one.seconds().contains("off-surface evaluation"));
}

BOOST_AUTO_TEST_CASE(cost_grows_with_the_logarithm_of_the_distance) {
  for (const int order : {12, 16, 24}) {
    const Matrix position = shape_33(order);
    LayerDensities laplace = all_densities(order);
    laplace.stokes_single = laplace.stokes_double = {};
    LayerDensities stokes;
    stokes.stokes_single = all_densities(order).stokes_single;
    const OffSurfaceLayers potential(position, laplace);
    const OffSurfaceLayers velocity(position, stokes);
    const MembranePoints points = membrane_points(position, scattered_angles(97));
    double least = 0.0;
    for (const double distance : {0.1, 1e-3, 1e-6, 1e-9}) {
      Instruments of_potential, of_velocity;
      const OffSurfaceValues v = potential.evaluate(points.at_height(distance), Side::exterior, of_potential);
      const OffSurfaceValues u = velocity.evaluate(points.at_height(distance), Side::exterior, of_velocity);
      BOOST_TEST(v.resolved.all());
      BOOST_TEST(u.resolved.all());
      const double nodes = of_potential.kernel_evaluations().at("laplace_double") / 100.0;
      if (distance == 0.1) least = nodes;
      const auto per_thousand = [](const Instruments& i) { return 10.0 * i.seconds().at("off-surface evaluation"); };
      BOOST_TEST_MESSAGE("p " << order << " distance " << distance << " nodes a target " << nodes
                              << " seconds per 1000 targets: S, D and gradients " << per_thousand(of_potential)
                              << ", Stokes " << per_thousand(of_velocity));
      BOOST_TEST(nodes < 3.0 * least);
    }
  }
}

BOOST_AUTO_TEST_CASE(only_requested_values_are_returned_and_sizes_must_agree) {
  const Matrix position = sphere(6);
  LayerDensities densities;
  densities.laplace_single = harmonic(6, 0, 0);
  const Matrix point = Vector3(0.0, 0.0, 0.5).transpose();
  const OffSurfaceValues v = evaluate(OffSurfaceLayers(position, densities), point);
  BOOST_TEST(v.laplace_single.values.rows() == 1);
  BOOST_TEST(v.laplace_single_gradient.values.rows() == 0);
  BOOST_TEST(v.laplace_double.values.rows() == 0);
  BOOST_TEST(v.stokes_single.values.rows() == 0);
  densities.laplace_double = harmonic(8, 0, 0);
  BOOST_CHECK_THROW(OffSurfaceLayers(position, densities), ShapeError);
}

BOOST_AUTO_TEST_SUITE_END()

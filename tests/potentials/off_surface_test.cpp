#include "bie/potentials/off_surface.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/support/errors.hpp"
#include "tests/potentials/off_surface_fields.hpp"
#include "tests/support/layers.hpp"
#include "tests/support/point_potential.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/targets.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(off_surface)

BOOST_AUTO_TEST_CASE(layers_of_harmonics_on_a_sphere_are_exact_at_every_distance_and_on_every_side) {
  constexpr int kOrder = 12;
  const double radius = 1.3;
  const Vector3 centre(0.4, -1.0, 2.0);
  const Matrix position = translated(sphere(kOrder, radius), centre);
  const GridAngles angles = scattered_angles(20);
  const MembranePoints points = membrane_points(position, angles);
  for (const auto& [n, m] : {std::pair{0, 0}, {1, -1}, {4, 3}, {9, 0}}) {
    const Vector y = harmonic(kOrder, n, m);
    LayerDensities densities;
    densities.laplace_single = radius * radius * y;
    densities.laplace_double = y;
    densities.gradients = true;
    const OffSurfaceLayers layers(position, densities);
    // At a distance of 1e-10 a rounding error of 1e-16 in the target is a relative error of 1e-6 in the height; the
    // value is not affected.
    for (const double height : heights(1.0)) {
      const OffSurfaceValues v = evaluate(layers, points.at_height(height));
      double error = 0.0;
      for (Index i = 0; i < angles.theta.size(); ++i) {
        const double r = radius + height;
        const auto exact = [&](const Radial& g) { return solid_harmonic(y, g, r, angles.theta[i], angles.phi[i]); };
        const ScalarAndGradient s = exact(single_of_sphere(n, radius, r, height < 0.0));
        const ScalarAndGradient d = exact(double_of_sphere(n, radius, r, height < 0.0));
        error = std::max({error, std::abs(v.laplace_single.values(i) - s.value),
                          std::abs(v.laplace_double.values(i) - d.value),
                          (v.laplace_single_gradient.values.row(i).transpose() - s.gradient).norm(),
                          (v.laplace_double_gradient.values.row(i).transpose() - d.gradient).norm() / (n + 1.0)});
      }
      BOOST_TEST(error < 1e-9, "degree " << n << " height " << height << " error " << error);
    }
    for (const Side side : kSides) {
      const OffSurfaceValues v = evaluate(layers, points.position, side);
      double error = 0.0;
      for (Index i = 0; i < angles.theta.size(); ++i) {
        const auto limit = [&, degree = n](const auto& layer) {
          const auto one_sided = [&](bool inside) {
            return solid_harmonic(y, layer(degree, radius, radius, inside), radius, angles.theta[i], angles.phi[i]);
          };
          const ScalarAndGradient in = one_sided(true);
          const ScalarAndGradient out = one_sided(false);
          if (side == Side::interior) return in;
          if (side == Side::exterior) return out;
          return ScalarAndGradient{0.5 * (in.value + out.value), 0.5 * (in.gradient + out.gradient)};
        };
        const ScalarAndGradient s = limit(single_of_sphere);
        const ScalarAndGradient d = limit(double_of_sphere);
        error = std::max({error, std::abs(v.laplace_single.values(i) - s.value),
                          std::abs(v.laplace_double.values(i) - d.value),
                          (v.laplace_single_gradient.values.row(i).transpose() - s.gradient).norm(),
                          (v.laplace_double_gradient.values.row(i).transpose() - d.gradient).norm() / (n + 1.0)});
      }
      BOOST_TEST(error < 1e-9, "degree " << n << " side " << static_cast<int>(side) << " error " << error);
    }
  }
}

BOOST_AUTO_TEST_CASE(double_layer_of_a_constant_is_the_solid_angle_and_gives_the_side) {
  const Matrix position = shape_33(16);
  LayerDensities densities;
  densities.laplace_double = std::sqrt(4.0 * std::numbers::pi) * harmonic(16, 0, 0);
  const OffSurfaceLayers layers(position, densities);
  const MembranePoints points = membrane_points(position, scattered_angles(30));
  for (const double height : heights(0.1)) {
    const OffSurfaceValues v = evaluate(layers, points.at_height(height));
    const double expected = height < 0.0 ? -1.0 : 0.0;
    BOOST_TEST(max_difference(v.laplace_double.values, Vector::Constant(33, expected)) < 1e-9, "height " << height);
    for (const Side side : v.side) BOOST_TEST((side == (height < 0.0 ? Side::interior : Side::exterior)));
  }
  for (const auto& [side, expected] :
       {std::pair{Side::interior, -1.0}, {Side::exterior, 0.0}, {Side::principal_value, -0.5}}) {
    const OffSurfaceValues v = evaluate(layers, points.position, side);
    BOOST_TEST(max_difference(v.laplace_double.values, Vector::Constant(33, expected)) < 1e-12);
    for (const Side found : v.side) BOOST_TEST((found == side));
  }
}

// On shape (33), whose nearest nodes depend on the direction: D[a + b × y] is −(a + b × x) inside and 0 outside.
BOOST_AUTO_TEST_CASE(stokes_double_layer_of_a_rigid_motion_is_the_motion_inside_and_nothing_outside) {
  const Matrix position = shape_33(16);
  const Vector3 a(0.3, -0.7, 1.1), b(-0.4, 0.9, 0.2);
  const auto motion = [&](const Matrix& x) {
    Matrix v(x.rows(), 3);
    for (Index i = 0; i < x.rows(); ++i) v.row(i) = b.cross(Vector3(x.row(i).transpose())).transpose();
    return v;
  };
  LayerDensities densities;
  densities.stokes_double = motion(position);
  densities.stokes_double.row(0) += std::sqrt(4.0 * std::numbers::pi) * a.transpose();
  const OffSurfaceLayers layers(position, densities);
  const MembranePoints points = membrane_points(position, scattered_angles(30));
  for (const double height : heights(0.1)) {
    const Matrix targets = points.at_height(height);
    const Matrix expected = (height < 0.0 ? -1.0 : 0.0) * (motion(targets).rowwise() + a.transpose());
    BOOST_TEST(max_difference(evaluate(layers, targets).stokes_double.values, expected) < 1e-9, "height " << height);
  }
  const Matrix on_membrane = motion(points.position).rowwise() + a.transpose();
  for (const auto& [side, share] :
       {std::pair{Side::interior, -1.0}, {Side::exterior, 0.0}, {Side::principal_value, -0.5}}) {
    const OffSurfaceValues v = evaluate(layers, points.position, side);
    BOOST_TEST(max_difference(v.stokes_double.values, share * on_membrane) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(green_representation_is_as_accurate_near_the_membrane_as_on_it) {
  for (const int order : {12, 16, 24}) {
    const PointField field(order, asymmetric_shape(order), {0.25, -0.1, 0.3}, {2.4, 1.1, -1.6});
    const MembranePoints points = membrane_points(field.position, scattered_angles(25));
    const PointField::Errors inside = field.errors(points.position, Side::interior);
    const PointField::Errors outside = field.errors(points.position, Side::exterior);
    for (const double height : heights(0.2)) {
      const bool is_inside = height < 0.0;
      const PointField::Errors at_height =
          field.errors(points.at_height(height), is_inside ? Side::interior : Side::exterior);
      const PointField::Errors on_membrane = is_inside ? inside : outside;
      BOOST_TEST_CONTEXT("order " << order << " height " << height) {
        BOOST_TEST(at_height.value < 1.5 * on_membrane.value + 1e-10);
        BOOST_TEST(at_height.gradient < 1.5 * on_membrane.gradient + 1e-9);
      }
    }
    BOOST_TEST(std::max(inside.value, outside.value) < (order == 12 ? 1.5e-4 : order == 16 ? 1.5e-5 : 2e-8));
    BOOST_TEST(std::max(inside.gradient, outside.gradient) < (order == 12 ? 1e-2 : order == 16 ? 8e-4 : 3e-6));
  }
}

BOOST_AUTO_TEST_CASE(smooth_ellipsoid_reaches_ten_digits) {
  const PointField field(24, ellipsoid(24, {1.0, 1.2, 1.5}), {0.05, 0.1, 0.02}, {3.0, 2.0, -2.5});
  const MembranePoints points = membrane_points(field.position, scattered_angles(25));
  for (const double height : heights(0.2)) {
    if (height > 0.0) continue;
    const PointField::Errors errors = field.errors(points.at_height(height), Side::interior);
    BOOST_TEST_CONTEXT("height " << height) {
      BOOST_TEST(errors.value < 1e-10);
      BOOST_TEST(errors.gradient < 2e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(values_agree_with_a_very_fine_smooth_rule) {
  // Grid spacing 0.02 against a distance of 0.1: exp(−2π 5) = 2e-14.
  constexpr int kOrder = 16;
  const Matrix position = asymmetric_shape(kOrder);
  const LayerDensities densities = all_densities(kOrder);
  const SphereTransform fine(kOrder, make_grid(240));
  const Surface surface = make_surface(fine, position);
  const SphereDerivatives f = fine.synthesize_gradient(densities.laplace_double);
  const Matrix gradient = surface_gradient(surface, f);
  const Matrix weighted_single = fine.synthesize(densities.laplace_single);
  const Matrix weighted_stokes = fine.synthesize(densities.stokes_single);
  const Matrix velocity = fine.synthesize(densities.stokes_double);
  const MembranePoints points = membrane_points(position, scattered_angles(5));
  for (const double height : {-0.12, 0.1}) {
    const Matrix targets = points.at_height(height);
    const OffSurfaceValues v = evaluate(OffSurfaceLayers(position, densities), targets);
    for (Index i = 0; i < targets.rows(); ++i) {
      double s = 0.0, d = 0.0;
      Vector3 grad_s = Vector3::Zero(), grad_d = Vector3::Zero(), u = Vector3::Zero(), w = Vector3::Zero();
      for (Index k = 0; k < surface.n_points(); ++k) {
        const Vector3 r = (targets.row(i) - surface.position.row(k)).transpose();
        const double r1 = r.norm();
        const double r3 = r1 * r1 * r1;
        const double dA = surface.quadrature[k];
        const double dw = dA / surface.area_element[k];
        const Vector3 n = surface.normal.row(k).transpose();
        const Vector3 force = weighted_stokes.row(k).transpose();
        s += dw * weighted_single(k) / r1;
        grad_s -= dw * weighted_single(k) / r3 * r;
        d += dA * f.value(k) * r.dot(n) / r3;
        // Gradient of the kernel: n/r³ − 3 (r·n) r/r⁵.
        grad_d += dA * f.value(k) * (n / r3 - 3.0 * r.dot(n) / (r3 * r1 * r1) * r);
        u += dw * (force / r1 + r.dot(force) / r3 * r);
        w += dA * velocity.row(k).dot(r) * r.dot(n) / (r3 * r1 * r1) * r;
      }
      const double four_pi = 4.0 * std::numbers::pi;
      BOOST_TEST(std::abs(v.laplace_single.values(i) - s / four_pi) < 1e-10);
      BOOST_TEST(std::abs(v.laplace_double.values(i) - d / four_pi) < 1e-9);
      BOOST_TEST((v.laplace_single_gradient.values.row(i).transpose() - grad_s / four_pi).norm() < 1e-9);
      BOOST_TEST((v.laplace_double_gradient.values.row(i).transpose() - grad_d / four_pi).norm() < 1e-8);
      BOOST_TEST((v.stokes_single.values.row(i).transpose() - u / (2.0 * four_pi)).norm() < 1e-10);
      BOOST_TEST((v.stokes_double.values.row(i).transpose() - 3.0 * w / four_pi).norm() < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(layers_approach_the_operators_on_the_membrane) {
  constexpr int kOrder = 32;
  const Space space(kOrder);
  const Matrix position = asymmetric_shape(kOrder);
  const LayerDensities densities = all_densities(kOrder);
  LayerSelection selection = kAllLayers;
  selection.stokes_double = true;
  const LayerOperators operators = assemble(space, position, selection);
  const GridAngles angles = scattered_angles(30);
  const MembranePoints points = membrane_points(position, angles);
  const auto on_membrane = [&](const Matrix& coefficients) {
    return evaluate_harmonics(coefficients, angles.theta, angles.phi);
  };
  const Matrix single = on_membrane(operators.laplace_single.apply(densities.laplace_single));
  const Matrix mean = on_membrane(operators.laplace_double.apply(densities.laplace_double));
  const Matrix f = on_membrane(densities.laplace_double);
  const Matrix stokes = on_membrane(operators.stokes_single.apply(densities.stokes_single));
  const Matrix mean_flow = on_membrane(operators.stokes_double.apply(densities.stokes_double));
  const Matrix velocity = on_membrane(densities.stokes_double);
  const OffSurfaceLayers layers(position, densities);
  for (const double height : {-1e-8, 0.0, 1e-8}) {
    const OffSurfaceValues v = evaluate(layers, points.at_height(height));
    BOOST_TEST_CONTEXT("height " << height) {
      BOOST_TEST(relative_difference(v.laplace_single.values, single) < 1e-7);
      BOOST_TEST(relative_difference(v.stokes_single.values, stokes) < 1e-7);
      const double share = height < 0.0 ? -0.5 : height > 0.0 ? 0.5 : 0.0;
      BOOST_TEST(relative_difference(v.laplace_double.values, mean + share * f) < 1e-7);
      BOOST_TEST(relative_difference(v.stokes_double.values, mean_flow + share * velocity) < 5e-7);
    }
  }
}

BOOST_AUTO_TEST_CASE(single_layers_are_continuous_and_the_others_jump_by_their_densities) {
  constexpr int kOrder = 16;
  const Matrix position = asymmetric_shape(kOrder);
  const LayerDensities densities = all_densities(kOrder);
  const GridAngles angles = scattered_angles(30);
  const MembranePoints points = membrane_points(position, angles);
  const OffSurfaceLayers layers(position, densities);
  // Over a distance of 1e-11 the fields change by less than their errors.
  const OffSurfaceValues in = evaluate(layers, points.at_height(-1e-11));
  const OffSurfaceValues out = evaluate(layers, points.at_height(1e-11));
  const Index n = angles.theta.size();
  Vector f(n);
  Matrix charge_jump(n, 3);
  Matrix gradient_jump(n, 3);
  const Matrix velocity = evaluate_harmonics(densities.stokes_double, angles.theta, angles.phi);
  for (Index i = 0; i < n; ++i) {
    const PointDerivatives x = point_derivatives(position, {angles.theta[i], angles.phi[i]});
    const PointDerivatives d = point_derivatives(densities.laplace_double, {angles.theta[i], angles.phi[i]});
    const double weighted_charge =
        point_derivatives(densities.laplace_single, {angles.theta[i], angles.phi[i]}).value[0];
    const Vector3 u = x.d1.transpose();
    const Vector3 v = x.d2.transpose();
    const Vector3 area = u.cross(v);
    f[i] = d.value[0];
    charge_jump.row(i) = weighted_charge / area.squaredNorm() * area.transpose();
    // ∇_γ f is determined by its products with the two tangents.
    Matrix3 tangents;
    tangents << u.transpose(), v.transpose(), area.transpose();
    gradient_jump.row(i) = -tangents.inverse().leftCols<2>() * Eigen::Vector2d(d.d1[0], d.d2[0]);
  }
  BOOST_TEST(max_difference(in.laplace_single.values, out.laplace_single.values) < 1e-9);
  BOOST_TEST(max_difference(in.stokes_single.values, out.stokes_single.values) < 1e-9);
  BOOST_TEST(max_difference(in.laplace_double.values - out.laplace_double.values, -f) < 1e-9);
  BOOST_TEST(max_difference(in.stokes_double.values - out.stokes_double.values, -velocity) < 1e-9);
  BOOST_TEST(max_difference(in.laplace_single_gradient.values - out.laplace_single_gradient.values, charge_jump) <
             1e-8);
  BOOST_TEST(max_difference(in.laplace_double_gradient.values - out.laplace_double_gradient.values, gradient_jump) <
             1e-7);
}

BOOST_AUTO_TEST_SUITE_END()

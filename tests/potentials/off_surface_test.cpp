#include "bie/potentials/off_surface.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/support/errors.hpp"
#include "tests/support/layers.hpp"
#include "tests/support/point_potential.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/targets.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr std::array kSides{Side::interior, Side::exterior, Side::principal_value};

OffSurfaceValues evaluate(const OffSurfaceLayers& layers, const Matrix& points, Side side = Side::principal_value) {
  Instruments instruments;
  OffSurfaceValues values = layers.evaluate(points, side, instruments);
  require_resolved(values, points);
  return values;
}

/// Harmonic Y of degree n on a sphere of radius R: both layers are g(r) Y on either side.
struct Radial {
  double value, derivative;
};

Radial single_of_sphere(int n, double radius, double r, bool inside) {
  const double odd = 2.0 * n + 1.0;
  if (inside) return {radius / odd * std::pow(r / radius, n), n / odd * std::pow(r / radius, n - 1)};
  return {radius / odd * std::pow(radius / r, n + 1), -(n + 1.0) / odd * std::pow(radius / r, n + 2)};
}

Radial double_of_sphere(int n, double radius, double r, bool inside) {
  const double odd = 2.0 * n + 1.0;
  if (inside)
    return {-(n + 1.0) / odd * std::pow(r / radius, n), -n * (n + 1.0) / odd / radius * std::pow(r / radius, n - 1)};
  return {n / odd * std::pow(radius / r, n + 1), -n * (n + 1.0) / odd / radius * std::pow(radius / r, n + 2)};
}

struct ScalarAndGradient {
  double value;
  Vector3 gradient;
};

/// g(r) Y with its gradient for the coefficients of Y.
ScalarAndGradient solid_harmonic(const Vector& y, const Radial& g, double r, double theta, double phi) {
  const PointDerivatives p = point_derivatives(y, theta, phi);
  const Vector3 radial(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  const Vector3 e_theta(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta));
  const Vector3 e_phi(-std::sin(phi), std::cos(phi), 0.0);
  return {g.value * p.value[0],
          g.derivative * p.value[0] * radial + g.value / r * (p.d1[0] * e_theta + p.d2[0] * e_phi)};
}

/// The harmonic potential of a point source, outside the membrane for the inside and the other way round, as S − D.
struct PointField {
  Space space;
  Matrix position;
  Surface surface;
  Vector3 inner, outer;
  OffSurfaceLayers layers;

  PointField(int order, Matrix coefficients, const Vector3& inner_source, const Vector3& outer_source)
      : space(order),
        position(std::move(coefficients)),
        surface(make_surface(space.fine, position)),
        inner(inner_source),
        outer(outer_source),
        layers(position, densities()) {}

  [[nodiscard]] LayerDensities densities() const {
    const PointPotential in = point_potential(surface, outer);
    const PointPotential out = point_potential(surface, inner);
    LayerDensities d;
    d.laplace_single = weighted(space, surface, in.flux - out.flux);
    d.laplace_double = space.fine.analyze(in.value - out.value);
    d.gradients = true;
    return d;
  }

  struct Errors {
    double value, gradient;
  };

  /// Largest errors over points on one side relative to the largest value there.
  [[nodiscard]] Errors errors(const Matrix& points, Side side) const {
    const OffSurfaceValues v = evaluate(layers, points, side);
    double value = 0.0, gradient = 0.0, value_scale = 0.0, gradient_scale = 0.0;
    for (Index i = 0; i < points.rows(); ++i) {
      BOOST_TEST((v.side[i] == side));
      const Vector3 r = points.row(i).transpose() - (side == Side::interior ? outer : inner);
      const double exact = kLaplacePrefactor / r.norm();
      const Vector3 exact_gradient = -exact / r.squaredNorm() * r;
      const Vector3 found =
          (v.laplace_single_gradient.values.row(i) - v.laplace_double_gradient.values.row(i)).transpose();
      value = std::max(value, std::abs(v.laplace_single.values(i) - v.laplace_double.values(i) - exact));
      gradient = std::max(gradient, (found - exact_gradient).norm());
      value_scale = std::max(value_scale, exact);
      gradient_scale = std::max(gradient_scale, exact_gradient.norm());
    }
    return {value / value_scale, gradient / gradient_scale};
  }
};

/// Everything at once on a shape without symmetry.
LayerDensities all_densities(int order) {
  LayerDensities d;
  d.laplace_single = smooth_coefficients(order, 6, 1, 61);
  d.laplace_double = smooth_coefficients(order, 6, 1, 62);
  d.stokes_single = smooth_coefficients(order, 6, 3, 63);
  d.gradients = true;
  return d;
}

}  // namespace

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
    // An error of 1e-16 in the position of a target is one of 1e-6 in the side at a distance of 1e-10, none in the
    // value.
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

BOOST_AUTO_TEST_CASE(double_layer_of_a_constant_is_the_solid_angle_and_tells_the_side) {
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
  const MembranePoints points = membrane_points(position, scattered_angles(5));
  for (const double height : {-0.12, 0.1}) {
    const Matrix targets = points.at_height(height);
    const OffSurfaceValues v = evaluate(OffSurfaceLayers(position, densities), targets);
    for (Index i = 0; i < targets.rows(); ++i) {
      double s = 0.0, d = 0.0;
      Vector3 grad_s = Vector3::Zero(), grad_d = Vector3::Zero(), u = Vector3::Zero();
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
        // The gradient of the kernel itself: n/r³ − 3 (r·n) r/r⁵.
        grad_d += dA * f.value(k) * (n / r3 - 3.0 * r.dot(n) / (r3 * r1 * r1) * r);
        u += dw * (force / r1 + r.dot(force) / r3 * r);
      }
      const double four_pi = 4.0 * std::numbers::pi;
      BOOST_TEST(std::abs(v.laplace_single.values(i) - s / four_pi) < 1e-10);
      BOOST_TEST(std::abs(v.laplace_double.values(i) - d / four_pi) < 1e-9);
      BOOST_TEST((v.laplace_single_gradient.values.row(i).transpose() - grad_s / four_pi).norm() < 1e-9);
      BOOST_TEST((v.laplace_double_gradient.values.row(i).transpose() - grad_d / four_pi).norm() < 1e-8);
      BOOST_TEST((v.stokes_single.values.row(i).transpose() - u / (2.0 * four_pi)).norm() < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(layers_approach_the_operators_on_the_membrane) {
  constexpr int kOrder = 32;
  const Space space(kOrder);
  const Matrix position = asymmetric_shape(kOrder);
  const LayerDensities densities = all_densities(kOrder);
  const LayerOperators operators = assemble(space, position, kAllLayers);
  const GridAngles angles = scattered_angles(30);
  const MembranePoints points = membrane_points(position, angles);
  const auto on_membrane = [&](const Matrix& coefficients) {
    return evaluate_harmonics(coefficients, angles.theta, angles.phi);
  };
  const Matrix single = on_membrane(operators.laplace_single.apply(densities.laplace_single));
  const Matrix mean = on_membrane(operators.laplace_double.apply(densities.laplace_double));
  const Matrix f = on_membrane(densities.laplace_double);
  const Matrix stokes = on_membrane(operators.stokes_single.apply(densities.stokes_single));
  const OffSurfaceLayers layers(position, densities);
  for (const double height : {-1e-8, 0.0, 1e-8}) {
    const OffSurfaceValues v = evaluate(layers, points.at_height(height));
    BOOST_TEST_CONTEXT("height " << height) {
      BOOST_TEST(relative_difference(v.laplace_single.values, single) < 1e-7);
      BOOST_TEST(relative_difference(v.stokes_single.values, stokes) < 1e-7);
      const double share = height < 0.0 ? -0.5 : height > 0.0 ? 0.5 : 0.0;
      BOOST_TEST(relative_difference(v.laplace_double.values, mean + share * f) < 1e-7);
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
  // At a distance of 1e-11 the fields themselves change by less than their errors.
  const OffSurfaceValues in = evaluate(layers, points.at_height(-1e-11));
  const OffSurfaceValues out = evaluate(layers, points.at_height(1e-11));
  const Index n = angles.theta.size();
  Vector f(n);
  Matrix charge_jump(n, 3);
  Matrix gradient_jump(n, 3);
  for (Index i = 0; i < n; ++i) {
    const PointDerivatives x = point_derivatives(position, angles.theta[i], angles.phi[i]);
    const PointDerivatives d = point_derivatives(densities.laplace_double, angles.theta[i], angles.phi[i]);
    const double weighted_charge = point_derivatives(densities.laplace_single, angles.theta[i], angles.phi[i]).value[0];
    const Vector3 u = x.d1.transpose();
    const Vector3 v = x.d2.transpose();
    const Vector3 area = u.cross(v);
    f[i] = d.value[0];
    charge_jump.row(i) = weighted_charge / area.squaredNorm() * area.transpose();
    // ∇_γ f from its two defining products with the tangents.
    Matrix3 tangents;
    tangents << u.transpose(), v.transpose(), area.transpose();
    gradient_jump.row(i) = -tangents.inverse().leftCols<2>() * Eigen::Vector2d(d.d1[0], d.d2[0]);
  }
  BOOST_TEST(max_difference(in.laplace_single.values, out.laplace_single.values) < 1e-9);
  BOOST_TEST(max_difference(in.stokes_single.values, out.stokes_single.values) < 1e-9);
  BOOST_TEST(max_difference(in.laplace_double.values - out.laplace_double.values, -f) < 1e-9);
  BOOST_TEST(max_difference(in.laplace_single_gradient.values - out.laplace_single_gradient.values, charge_jump) <
             1e-8);
  BOOST_TEST(max_difference(in.laplace_double_gradient.values - out.laplace_double_gradient.values, gradient_jump) <
             1e-7);
}

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
  // The true error of a smooth density on a sphere is that of the quadrature alone.
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

BOOST_AUTO_TEST_CASE(sheets_closer_than_the_nodes_are_told_apart) {
  // A disc of half thickness t with the poles of its grid elsewhere: nodes of its two sheets face gaps of each other.
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
  BOOST_TEST(max_difference(serial.laplace_double_gradient.values, parallel.laplace_double_gradient.values) == 0.0);
  for (const char* kernel :
       {"laplace_single", "laplace_single_gradient", "laplace_double", "laplace_double_gradient", "stokes_single"}) {
    BOOST_TEST(one.kernel_evaluations().at(kernel) > 36u * 1000u);
    BOOST_TEST(one.kernel_evaluations().at(kernel) == three.kernel_evaluations().at(kernel));
  }
  BOOST_TEST(one.seconds().contains("off-surface evaluation"));
}

BOOST_AUTO_TEST_CASE(cost_grows_with_the_logarithm_of_the_distance) {
  for (const int order : {12, 16, 24}) {
    const Matrix position = shape_33(order);
    LayerDensities laplace = all_densities(order);
    laplace.stokes_single = {};
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

BOOST_AUTO_TEST_CASE(only_what_is_asked_for_comes_back_and_sizes_must_agree) {
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

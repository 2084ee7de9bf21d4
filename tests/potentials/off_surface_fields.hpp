#pragma once

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <utility>

#include "bie/potentials/off_surface.hpp"
#include "bie/sphere/point_derivatives.hpp"
#include "tests/support/layers.hpp"
#include "tests/support/point_potential.hpp"
#include "tests/support/shapes.hpp"

namespace vehd::testing {

inline constexpr std::array kSides{Side::interior, Side::exterior, Side::principal_value};

inline OffSurfaceValues evaluate(const OffSurfaceLayers& layers, const Matrix& points,
                                 Side side = Side::principal_value) {
  Instruments instruments;
  OffSurfaceValues values = layers.evaluate(points, side, instruments);
  require_resolved(values, points);
  return values;
}

/// Harmonic Y of degree n on a sphere of radius R: both layers are g(r) Y on either side.
struct Radial {
  double value, derivative;
};

inline Radial single_of_sphere(int n, double radius, double r, bool inside) {
  const double odd = 2.0 * n + 1.0;
  if (inside) return {radius / odd * std::pow(r / radius, n), n / odd * std::pow(r / radius, n - 1)};
  return {radius / odd * std::pow(radius / r, n + 1), -(n + 1.0) / odd * std::pow(radius / r, n + 2)};
}

inline Radial double_of_sphere(int n, double radius, double r, bool inside) {
  const double odd = 2.0 * n + 1.0;
  if (inside)
    return {-(n + 1.0) / odd * std::pow(r / radius, n), -n * (n + 1.0) / odd / radius * std::pow(r / radius, n - 1)};
  return {n / odd * std::pow(radius / r, n + 1), -n * (n + 1.0) / odd / radius * std::pow(radius / r, n + 2)};
}

struct ScalarAndGradient {
  double value;
  Vector3 gradient;
};

/// Value and gradient of g(r) Y for the coefficients of Y.
inline ScalarAndGradient solid_harmonic(const Vector& y, const Radial& g, double r, double theta, double phi) {
  const PointDerivatives p = point_derivatives(y, {theta, phi});
  const Vector3 radial(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  const Vector3 e_theta(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta));
  const Vector3 e_phi(-std::sin(phi), std::cos(phi), 0.0);
  return {g.value * p.value[0],
          g.derivative * p.value[0] * radial + g.value / r * (p.d1[0] * e_theta + p.d2[0] * e_phi)};
}

/// Harmonic potential of a point source on the opposite side of the membrane, represented as S − D.
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

/// Densities of all layers on a shape without symmetry.
inline LayerDensities all_densities(int order) {
  LayerDensities d;
  d.laplace_single = smooth_coefficients(order, 6, 1, 61);
  d.laplace_double = smooth_coefficients(order, 6, 1, 62);
  d.stokes_single = smooth_coefficients(order, 6, 3, 63);
  d.stokes_double = smooth_coefficients(order, 6, 3, 64);
  d.gradients = true;
  return d;
}

}  // namespace vehd::testing

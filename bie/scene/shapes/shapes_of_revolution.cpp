#include "bie/scene/shapes/shapes_of_revolution.hpp"

#include <cmath>
#include <numbers>

#include "bie/scene/shapes/placement.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

/// Zero, to rounding, of a function that changes sign once between lower and upper, from − to +.
template <typename Function>
double rising_zero(const Function& function, double lower, double upper) {
  for (double middle = 0.5 * (lower + upper); middle > lower && middle < upper; middle = 0.5 * (lower + upper)) {
    (function(middle) < 0.0 ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

/// Integral from −1 to 1.
template <typename Function>
double integral(const GaussLegendre& rule, const Function& function) {
  double sum = 0.0;
  for (Index i = 0; i < rule.nodes.size(); ++i) sum += rule.weights(i) * function(rule.nodes(i));
  return sum;
}

/// Area over 4π of the spheroid with the semi-axes 1, 1, c.
double spheroid_area(double c) {
  if (c == 1.0) return 1.0;
  const double shorter_over_longer = c > 1.0 ? 1.0 / c : c;
  const double eccentricity = std::sqrt((1.0 - shorter_over_longer) * (1.0 + shorter_over_longer));
  const double cap = c > 1.0 ? c * std::asin(eccentricity) : c * c * std::atanh(eccentricity);
  return 0.5 * (1.0 + cap / eccentricity);
}

/// @param sign  of the derivative of the reduced volume with respect to c between these bounds
Triple spheroid_axes(double reduced_volume, double sign, double lower, double upper) {
  // The reduced volume is stationary in c at the sphere, where the search would be inaccurate.
  if (reduced_volume == 1.0) return {1.0, 1.0, 1.0};
  // V/(4π/3) over (A/4π)^{3/2} is the reduced volume.
  const auto excess = [&](double c) { return sign * (c / std::pow(spheroid_area(c), 1.5) - reduced_volume); };
  const double c = rising_zero(excess, lower, upper);
  const double a = 1.0 / std::sqrt(spheroid_area(c));
  return {a, a, a * c};
}

/// Area over 4π of the biconcave disc with R = 1. With c = cos θ and k = 1 − d its height is z = (c − k c³)/2.
double disc_area(double k, const GaussLegendre& rule) {
  return 0.5 * integral(rule, [k](double c) {
           const double c2 = c * c;
           const double slope = 0.5 * (1.0 - 3.0 * k * c2);
           return std::sqrt(c2 + (1.0 - c2) * slope * slope);
         });
}

constexpr double bend = 2.2;

/// Area over 4π of the stomatocyte with R = 1 and the wall w, by Gauss quadrature in θ.
double bowl_area(double w, const GaussLegendre& rule) {
  return 0.5 * std::numbers::pi * integral(rule, [w](double node) {
           const double theta = 0.5 * std::numbers::pi * (1.0 + node);
           const double r = 1.0 + w * std::cos(theta);
           const double arc = std::hypot(w * std::sin(theta), r * bend * std::cos(theta));
           return 0.5 * r * std::sin(bend * std::sin(theta)) * arc;
         });
}

/// Volume over 4π/3 of this stomatocyte. Between the inner and the outer wall at the angle α there is ((1 + w cos θ)³ −
/// (1 − w cos θ)³)/3 per solid angle.
double bowl_volume(double w, const GaussLegendre& rule) {
  return 0.25 * std::numbers::pi * integral(rule, [w](double node) {
           const double theta = 0.25 * std::numbers::pi * (1.0 + node);
           const double half = w * std::cos(theta);
           const double per_solid_angle = 2.0 * half + 2.0 / 3.0 * half * half * half;
           return 1.5 * per_solid_angle * std::sin(bend * std::sin(theta)) * bend * std::cos(theta);
         });
}

}  // namespace

Triple prolate_axes(double reduced_volume) { return spheroid_axes(reduced_volume, -1.0, 1.0, 100.0); }

Triple oblate_axes(double reduced_volume) { return spheroid_axes(reduced_volume, 1.0, 0.01, 1.0); }

Matrix biconcave_position(double reduced_volume, int order) {
  // The area is accurate to rounding for every k.
  const GaussLegendre rule = gauss_legendre(256);
  const auto excess = [&](double k) { return reduced_volume - (0.5 - 0.3 * k) / std::pow(disc_area(k, rule), 1.5); };
  const double k = rising_zero(excess, 1.0 / 3.0, 1.0);
  const double radius = 1.0 / std::sqrt(disc_area(k, rule));
  const auto unit_harmonic = [](int n) { return std::sqrt(4.0 * std::numbers::pi / (2 * n + 1)); };
  Matrix position = Matrix::Zero(n_coefficients(order), 3);
  position(coefficient_index(1, 1), 0) = radius * unit_harmonic(1);
  position(coefficient_index(1, -1), 1) = radius * unit_harmonic(1);
  // c³ = (3 P_1 + 2 P_3)/5.
  position(coefficient_index(1, 0), 2) = 0.5 * radius * (1.0 - 0.6 * k) * unit_harmonic(1);
  position(coefficient_index(3, 0), 2) = -0.2 * radius * k * unit_harmonic(3);
  return position;
}

Matrix stomatocyte_position(double reduced_volume, int order) {
  // Area and volume are accurate to rounding, at the sharp rim of a thin wall as well.
  const GaussLegendre rule = gauss_legendre(512);
  constexpr double thinnest = 0.01, thickest = 0.6;
  const auto excess = [&](double w) {
    return bowl_volume(w, rule) / std::pow(bowl_area(w, rule), 1.5) - reduced_volume;
  };
  const double w = rising_zero(excess, thinnest, thickest);
  const double scale = 1.0 / std::sqrt(bowl_area(w, rule));
  return without_rounding(position_through(shape_transform(order), [&](Index, double theta, double phi) -> Vector3 {
    const double alpha = bend * std::sin(theta);
    return scale * (1.0 + w * std::cos(theta)) *
           Vector3(std::sin(alpha) * std::cos(phi), std::sin(alpha) * std::sin(phi), std::cos(alpha));
  }));
}

}  // namespace vehd

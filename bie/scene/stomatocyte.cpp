#include "bie/scene/stomatocyte.hpp"

#include <cmath>
#include <numbers>

#include "bie/scene/bisection.hpp"
#include "bie/scene/placement.hpp"
#include "bie/scene/shape_nodes.hpp"

namespace vehd {
namespace {

constexpr double bend = 2.2;
/// Area and volume are then exact to rounding, at the sharp rim of a thin wall as well.
constexpr int n_meridian_nodes = 512;

/// The bowl with R = 1.
struct Bowl {
  double wall;  ///< w

  [[nodiscard]] double radius(double theta) const { return 1.0 + wall * std::cos(theta); }

  /// Of the surface over 4π and of the volume over 4π/3, by Gauss quadrature in θ.
  [[nodiscard]] double reduced_volume(const GaussLegendre& rule) const {
    return relative_volume(rule) / std::pow(relative_area(rule), 1.5);
  }

  [[nodiscard]] double relative_area(const GaussLegendre& rule) const {
    return integral(rule, std::numbers::pi, [this](double theta) {
      const double r = radius(theta);
      const double arc = std::hypot(wall * std::sin(theta), r * bend * std::cos(theta));
      return 0.5 * r * std::sin(bend * std::sin(theta)) * arc;
    });
  }

  /// Between the inner and the outer wall at the angle α: ((1 + w cos θ)³ − (1 − w cos θ)³)/3 per solid angle.
  [[nodiscard]] double relative_volume(const GaussLegendre& rule) const {
    return integral(rule, 0.5 * std::numbers::pi, [this](double theta) {
      const double half = wall * std::cos(theta);
      const double per_solid_angle = 2.0 * half + 2.0 / 3.0 * half * half * half;
      return 1.5 * per_solid_angle * std::sin(bend * std::sin(theta)) * bend * std::cos(theta);
    });
  }

 private:
  template <typename Function>
  static double integral(const GaussLegendre& rule, double length, const Function& function) {
    double sum = 0.0;
    for (Index i = 0; i < rule.nodes.size(); ++i) {
      sum += rule.weights(i) * function(0.5 * length * (1.0 + rule.nodes(i)));
    }
    return 0.5 * length * sum;
  }
};

}  // namespace

Matrix stomatocyte_position(double reduced_volume, int order) {
  const GaussLegendre rule = gauss_legendre(n_meridian_nodes);
  constexpr double thinnest = 0.01, thickest = 0.6;
  const double wall =
      rising_zero([&](double trial) { return Bowl{trial}.reduced_volume(rule) - reduced_volume; }, thinnest, thickest);
  const Bowl bowl{wall};
  const double scale = 1.0 / std::sqrt(bowl.relative_area(rule));
  return without_rounding(position_through(shape_transform(order), [&](Index, double theta, double phi) -> Vector3 {
    const double alpha = bend * std::sin(theta);
    return scale * bowl.radius(theta) *
           Vector3(std::sin(alpha) * std::cos(phi), std::sin(alpha) * std::sin(phi), std::cos(alpha));
  }));
}

}  // namespace vehd

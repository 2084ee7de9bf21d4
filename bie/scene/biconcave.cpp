#include "bie/scene/biconcave.hpp"

#include <cmath>
#include <numbers>

#include "bie/scene/bisection.hpp"
#include "bie/sphere/grid.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

constexpr double smallest_depth = 1.0 / 3.0;
/// The area is then exact to rounding for every depth.
constexpr int n_nodes = 256;

/// The disc with R = 1. With c = cos θ and the depth k = 1 − d its height is z = (c − k c³)/2.
struct Disc {
  double depth;

  /// Area over 4π, by Gauss quadrature in c.
  [[nodiscard]] double relative_area(const GaussLegendre& rule) const {
    double area = 0.0;
    for (Index i = 0; i < rule.nodes.size(); ++i) {
      const double c2 = rule.nodes(i) * rule.nodes(i);
      const double slope = 0.5 * (1.0 - 3.0 * depth * c2);
      area += rule.weights(i) * std::sqrt(c2 + (1.0 - c2) * slope * slope);
    }
    return 0.5 * area;
  }
  /// Volume over 4π/3.
  [[nodiscard]] double relative_volume() const { return 0.5 - 0.3 * depth; }
};

double unit_harmonic(int n) { return std::sqrt(4.0 * std::numbers::pi / (2 * n + 1)); }

}  // namespace

Matrix biconcave_position(double reduced_volume, int order) {
  const GaussLegendre rule = gauss_legendre(n_nodes);
  const auto excess = [&](double depth) {
    const Disc disc{depth};
    return reduced_volume - disc.relative_volume() / std::pow(disc.relative_area(rule), 1.5);
  };
  const double depth = rising_zero(excess, smallest_depth, 1.0);
  const double radius = 1.0 / std::sqrt(Disc{depth}.relative_area(rule));
  Matrix position = Matrix::Zero(n_coefficients(order), 3);
  position(coefficient_index(1, 1), 0) = radius * unit_harmonic(1);
  position(coefficient_index(1, -1), 1) = radius * unit_harmonic(1);
  // c³ = (3 P_1 + 2 P_3)/5.
  position(coefficient_index(1, 0), 2) = 0.5 * radius * (1.0 - 0.6 * depth) * unit_harmonic(1);
  position(coefficient_index(3, 0), 2) = -0.2 * radius * depth * unit_harmonic(3);
  return position;
}

}  // namespace vehd

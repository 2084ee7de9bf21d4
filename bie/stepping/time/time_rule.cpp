#include "bie/stepping/time/time_rule.hpp"

#include <cmath>
#include <numeric>

namespace vehd {

TimeRule time_rule(int order) {
  if (order == 1) return {{1.0}, Matrix::Zero(1, 2), {1.0}};
  if (order == 2) return {{1.0}, Matrix{{0.5, 0.5}}, {1.0}};
  const double s = std::sqrt(6.0);
  if (order == 3) {
    // D from the trace and the determinant of I − D⁻¹Q, both 0 after subtracting the eigenvalue.
    const double d1 = 10.0 / (24.0 + 6.0 * s);
    return {{1.0 / 3.0, 1.0},
            Matrix{{0.0, 5.0 / 12.0, -1.0 / 12.0}, {0.0, 3.0 / 4.0, 1.0 / 4.0}},
            {d1, 1.0 / (8.0 - 5.0 / (3.0 * d1))}};
  }
  return {{0.4 - 0.1 * s, 0.4 + 0.1 * s, 1.0},
          Matrix{{0.0, (88.0 - 7.0 * s) / 360.0, (296.0 - 169.0 * s) / 1800.0, (3.0 * s - 2.0) / 225.0},
                 {0.0, (296.0 + 169.0 * s) / 1800.0, (88.0 + 7.0 * s) / 360.0, -(3.0 * s + 2.0) / 225.0},
                 {0.0, (16.0 - s) / 36.0, (16.0 + s) / 36.0, 1.0 / 9.0}},
          {0.10404994025001671, 0.33281274542850664, 0.4812901402100925}};
}

std::vector<double> points_of(const TimeRule& rule) {
  std::vector<double> points{0.0};
  points.insert(points.end(), rule.nodes.begin(), rule.nodes.end());
  return points;
}

namespace {

double power_of(double x, Index k) { return k == 0 ? 1.0 : std::pow(x, static_cast<double>(k)); }

/// Weights w with Σ_j w_j x_j^k equal to the kth moment.
Vector weights_of_moments(const std::vector<double>& points, const Vector& moments) {
  Matrix powers(moments.size(), moments.size());
  for (Index k = 0; k < moments.size(); ++k) {
    for (Index j = 0; j < moments.size(); ++j) powers(k, j) = power_of(points[static_cast<std::size_t>(j)], k);
  }
  return powers.partialPivLu().solve(moments);
}

}  // namespace

Vector integration_weights(const std::vector<double>& points, double c) {
  Vector integrals(static_cast<Index>(points.size()));
  for (Index k = 0; k < integrals.size(); ++k) integrals[k] = power_of(c, k + 1) / static_cast<double>(k + 1);
  return weights_of_moments(points, integrals);
}

Vector weights_from_zero(const Vector& places, double x) {
  Vector weights(places.size());
  for (Index i = 0; i < places.size(); ++i) {
    double weight = x / places[i];
    for (Index j = 0; j < places.size(); ++j) {
      if (j != i) weight *= (x - places[j]) / (places[i] - places[j]);
    }
    weights[i] = weight;
  }
  return weights;
}

double integration_error(const std::vector<double>& points, double c, int power) {
  const Vector weights = integration_weights(points, c);
  double residual = power_of(c, power + 1) / (power + 1.0);
  for (std::size_t j = 0; j < points.size(); ++j) {
    residual -= weights[static_cast<Index>(j)] * power_of(points[j], power);
  }
  return residual / std::tgamma(power + 1.0);
}

Vector derivative_weights(const std::vector<double>& points, int derivative) {
  const double mean = std::accumulate(points.begin(), points.end(), 0.0) / static_cast<double>(points.size());
  Vector derivatives = Vector::Zero(static_cast<Index>(points.size()));
  for (Index k = derivative; k < derivatives.size(); ++k) {
    derivatives[k] = power_of(mean, k - derivative);
    for (int i = 0; i < derivative; ++i) derivatives[k] *= static_cast<double>(k - i);
  }
  return weights_of_moments(points, derivatives);
}

}  // namespace vehd

#include "bie/sphere/grid.hpp"

#include <cmath>
#include <numbers>

namespace vehd {

namespace {

struct LegendreValue {
  double value;
  double derivative;
};

LegendreValue legendre_polynomial(int n, double x) {
  double previous = 1.0;
  double current = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k;
    previous = current;
    current = next;
  }
  return {current, n * (previous - x * current) / ((1.0 - x) * (1.0 + x))};
}

bool has_large_prime(int n) {
  for (const int prime : {2, 3, 5, 7, 11, 13}) {
    while (n % prime == 0) n /= prime;
  }
  return n > 1;
}

}  // namespace

int fast_longitudes(int least, int step) {
  int count = (least + step - 1) / step;
  while (has_large_prime(count)) ++count;
  return step * count;
}

GaussLegendre gauss_legendre(int n) {
  GaussLegendre rule{Vector::Zero(n), Vector::Zero(n)};
  if (n == 1) {
    rule.weights[0] = 2.0;
    return rule;
  }
  for (int i = 0; i < (n + 1) / 2; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    // Newton converges quadratically from this guess; the last pass leaves the derivative at the final node.
    LegendreValue p{};
    for (int iteration = 0; iteration < 10; ++iteration) {
      p = legendre_polynomial(n, x);
      const double correction = p.value / p.derivative;
      x -= correction;
      if (std::abs(correction) < 1e-16) break;
    }
    p = legendre_polynomial(n, x);
    const double weight = 2.0 / ((1.0 - x) * (1.0 + x) * p.derivative * p.derivative);
    rule.nodes[n - 1 - i] = x;
    rule.nodes[i] = -x;
    rule.weights[n - 1 - i] = weight;
    rule.weights[i] = weight;
  }
  if (n % 2 == 1) rule.nodes[n / 2] = 0.0;
  return rule;
}

SphereGrid make_grid(int order) { return make_grid(order, 2 * order + 2); }

SphereGrid make_grid(int order, int n_phi) {
  SphereGrid grid;
  grid.order = order;
  grid.n_theta = order + 1;
  grid.n_phi = n_phi;
  const GaussLegendre rule = gauss_legendre(grid.n_theta);
  grid.theta.resize(grid.n_theta);
  grid.weight.resize(grid.n_theta);
  const double delta_phi = 2.0 * std::numbers::pi / grid.n_phi;
  for (int j = 0; j < grid.n_theta; ++j) {
    grid.theta[j] = std::acos(rule.nodes[grid.n_theta - 1 - j]);
    grid.weight[j] = rule.weights[grid.n_theta - 1 - j] * delta_phi;
  }
  grid.phi = Vector::LinSpaced(grid.n_phi, 0.0, delta_phi * (grid.n_phi - 1));
  return grid;
}

}  // namespace vehd

#include "bie/potentials/rotated_quadrature.hpp"

#include <cmath>
#include <numbers>

#include "bie/sphere/legendre.hpp"

namespace vehd {

RotatedQuadrature make_rotated_quadrature(const SphereGrid& targets, double oversampling) {
  RotatedQuadrature q;
  q.order = targets.order;
  const int order = q.order;
  // The additional nodes are for low orders, where the surface rather than the density determines the resolution.
  q.n_theta = static_cast<int>(std::ceil(oversampling * order)) + 4;
  q.n_phi = 4 * ((2 * q.n_theta + 3) / 4);
  const GaussLegendre rule = gauss_legendre(q.n_theta);
  const Vector theta = (rule.nodes.array() + 1.0) * (std::numbers::pi / 2);
  q.weight = rule.weights.array() * (std::numbers::pi / 2) * theta.array().sin() * (2.0 * std::numbers::pi / q.n_phi);

  const LegendreTables legendre = legendre_tables(order, theta);
  for (int m = 0; m <= order; ++m) {
    RowMatrix stack(3 * q.n_theta, order + 1 - m);
    stack << legendre.value[m], legendre.d_theta[m], legendre.m_over_sin[m];
    q.synthesis.push_back(std::move(stack));
  }

  const int quarter = q.n_phi / 4;
  const int n_even = order / 2 + 1;
  const int n_odd = (order + 1) / 2;
  q.cosine_even.resize(quarter, n_even);
  q.sine_even.resize(quarter, n_even);
  q.cosine_odd.resize(quarter, n_odd);
  q.sine_odd.resize(quarter, n_odd);
  for (int i = 0; i < quarter; ++i) {
    const double phi = (i + 0.5) * 2.0 * std::numbers::pi / q.n_phi;
    for (int m = 0; m <= order; ++m) {
      (m % 2 == 0 ? q.cosine_even : q.cosine_odd)(i, m / 2) = std::cos(m * phi);
      (m % 2 == 0 ? q.sine_even : q.sine_odd)(i, m / 2) = std::sin(m * phi);
    }
  }

  const std::vector<Matrix> target_legendre = legendre_tables(order, targets.theta).value;
  for (int m = 0; m <= order; ++m) {
    // ∫ cos² mφ dφ is half of ∫ 1 dφ.
    const Vector scaled = targets.weight * (targets.n_phi * (m == 0 ? 1.0 : 0.5));
    q.target_analysis.emplace_back(scaled.asDiagonal() * target_legendre[m]);
  }

  q.rotations.resize(targets.n_theta);
#pragma omp parallel for schedule(dynamic, 1)
  for (int j = 0; j < targets.n_theta; ++j) q.rotations[j] = rotation_y(order, targets.theta[j]);
  return q;
}

}  // namespace vehd

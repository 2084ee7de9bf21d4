#include "bie/stepping/reparametrisation.hpp"

#include <cmath>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

SphereVectors sliding_part(const SphereTransform& fine, const Surface& s, const Matrix& displacement) {
  const SphereDerivatives u = fine.synthesize_gradient(displacement);
  const Vector normal = u.value.cwiseProduct(s.normal).rowwise().sum();
  const Vector divergence =
      s.area_element.cwiseProduct(surface_divergence(s, u) + 2.0 * s.mean_curvature.cwiseProduct(normal));
  Vector potential = fine.analyze(divergence);
  potential[0] = 0.0;
  for (int n = 1; n <= fine.order(); ++n) {
    potential.segment(coefficient_index(n, -n), 2 * n + 1) /= -double(n) * (n + 1);
  }
  const SphereDerivatives psi = fine.synthesize_gradient(potential);
  return {u.value.cwiseProduct(s.dual_1).rowwise().sum() - psi.d1.col(0).cwiseQuotient(s.area_element),
          u.value.cwiseProduct(s.dual_2).rowwise().sum() - psi.d2.col(0).cwiseQuotient(s.area_element)};
}

namespace {

/// Parameter displacement along ∇E, E = ½ Σ a_n |x_nm|² with a_n rising from 0 at n = 1 to 1 at n = p.
SphereVectors smoothing_gradient(const SphereTransform& fine, const Surface& s, const Matrix& position) {
  Matrix gradient = position;
  const int order = fine.order();
  for (int n = 0; n <= order; ++n) {
    const double ratio = (n * (n + 1.0) - 2.0) / (order * (order + 1.0) - 2.0);
    gradient.middleRows(coefficient_index(n, -n), 2 * n + 1) *= n == 0 ? 0.0 : ratio * ratio;
  }
  const Matrix values = fine.synthesize(gradient);
  return {values.cwiseProduct(s.dual_1).rowwise().sum(), values.cwiseProduct(s.dual_2).rowwise().sum()};
}

}  // namespace

Matrix reparametrise(const SphereTransform& fine, const Surface& surface, const Matrix& position,
                     const Matrix& displacement, const Matrix& fields) {
  const SphereVectors sliding = sliding_part(fine, surface, displacement);
  const SphereVectors smoothing = smoothing_gradient(fine, surface, position);
  const SphereGrid& grid = fine.grid();
  Vector theta(grid.n_points());
  Vector phi(grid.n_points());
  for (int j = 0; j < grid.n_theta; ++j) {
    const double cos_theta = std::cos(grid.theta[j]);
    const double sin_theta = std::sin(grid.theta[j]);
    for (int k = 0; k < grid.n_phi; ++k) {
      const Index i = Index{j} * grid.n_phi + k;
      const double d1 = -sliding.d1[i] - smoothing.d1[i];
      const double d2 = -sliding.d2[i] - smoothing.d2[i];
      // Great circle from the node in the direction d; along the meridian frame (r̂, e_θ, e_φ) of the node.
      const double length = std::hypot(d1, d2);
      const double sinc = length < 1e-8 ? 1.0 : std::sin(length) / length;
      const double radial = std::cos(length);
      const double x = radial * sin_theta + sinc * d1 * cos_theta;
      const double y = sinc * d2;
      const double z = radial * cos_theta - sinc * d1 * sin_theta;
      theta[i] = std::atan2(std::hypot(x, y), z);
      phi[i] = grid.phi[k] + std::atan2(y, x);
    }
  }
  return fine.analyze(evaluate_harmonics(fields, theta, phi));
}

}  // namespace vehd

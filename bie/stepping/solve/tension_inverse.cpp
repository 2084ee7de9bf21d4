#include "bie/stepping/solve/tension_inverse.hpp"

#include <cmath>
#include <numeric>

#include "bie/geometry/surface.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Coefficients of J f_λ for every harmonic λ, one component below the other: [3 n_coefficients x n_coefficients].
Matrix tension_forces(const Membrane& membrane, const TensionGrid& grid) {
  const Surface s = make_surface(grid.transform, membrane.fine.analyze(membrane.surface.position));
  const SphereDerivatives& lambda = grid.harmonics;
  const Index n = lambda.value.cols();
  const Vector normal_part = 2.0 * s.area_element.cwiseProduct(s.mean_curvature);
  Matrix result(3 * n, n);
  for (int k = 0; k < 3; ++k) {
    // f_λ = ∇_γ λ + 2 λ H n
    const Matrix force = s.area_element.cwiseProduct(s.dual_1.col(k)).asDiagonal() * lambda.d1 +
                         s.area_element.cwiseProduct(s.dual_2.col(k)).asDiagonal() * lambda.d2 +
                         normal_part.cwiseProduct(s.normal.col(k)).asDiagonal() * lambda.value;
    result.middleRows(k * n, n) = grid.transform.analyze(force);
  }
  return result;
}

}  // namespace

TensionGrid::TensionGrid(int order)
    : transform(order, make_grid(order)),
      harmonics(transform.synthesize_gradient(Matrix::Identity(n_coefficients(order), n_coefficients(order)))) {}

TensionInverse::TensionInverse(const FlowMembrane& one, const TensionGrid& grid, std::vector<Index> entries,
                               double mean_response) {
  const Membrane& membrane = one.membrane;
  const Matrix forces = tension_forces(membrane, grid)(Eigen::all, entries);
  std::vector<Index> components(static_cast<std::size_t>(forces.rows()));
  std::iota(components.begin(), components.end(), Index{0});
  const Index n = forces.rows() / 3;
  Matrix velocities = membrane.layers.stokes_single.between(n, components) * forces / one.parameters.viscosity;
  if (membrane.contrast) {
    for (Index j = 0; j < velocities.cols(); ++j) {
      velocities.col(j) = membrane.velocity(velocities.col(j).reshaped(n, 3)).reshaped();
    }
  }
  const Matrix response = -forces.transpose() * velocities;
  const Index n_others = response.rows() - 1;
  beyond_mean_ = response.bottomRightCorner(n_others, n_others).partialPivLu();
  to_mean_ = response.row(0).tail(n_others);
  of_mean_ = beyond_mean_.solve(response.col(0).tail(n_others));
  constexpr double kLeastShare = 0.1;
  const double least = kLeastShare * std::abs(mean_response);
  mean_ = std::min(response(0, 0) - to_mean_ * of_mean_, -least);
}

Vector TensionInverse::apply(const Vector& divergence) const {
  const Index n_others = divergence.size() - 1;
  const Vector others = beyond_mean_.solve(divergence.tail(n_others));
  Vector result(divergence.size());
  result[0] = (divergence[0] - to_mean_ * others) / mean_;
  result.tail(n_others) = others - result[0] * of_mean_;
  return result;
}

}  // namespace vehd

#include "bie/stepping/space/remap.hpp"

#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/neighbourhood.hpp"
#include "bie/stepping/state/field_table.hpp"

namespace vehd {

namespace {

/// Sliding of degree n by an angle a is undone up to this phase n a: one step along great circles no longer follows a
/// wave that has slid by a quarter of its length (π/2).
constexpr double largest_phase = 1.5;
/// Exponent of the fade-out there: half at the phase, a thousandth at 2.4 times it.
constexpr int phase_power = 8;
/// Sliding below this is rounding.
constexpr double no_sliding = 1e-13;

}  // namespace

SphereVectors displacement_of_divergence(const SphereTransform& fine, const Surface& s,
                                         const Vector& weighted_divergence) {
  Vector potential = fine.analyze(weighted_divergence);
  potential[0] = 0.0;
  for (int n = 1; n <= fine.order(); ++n) {
    potential.segment(coefficient_index(n, -n), 2 * n + 1) /= -double(n) * (n + 1);
  }
  const SphereDerivatives psi = fine.synthesize_gradient(potential);
  return {psi.d1.col(0).cwiseQuotient(s.area_element), psi.d2.col(0).cwiseQuotient(s.area_element)};
}

SphereVectors sliding_part(const SphereTransform& fine, const Surface& s, const Matrix& displacement) {
  SphereDerivatives u = fine.synthesize_gradient(displacement);
  u.value.rowwise() -= surface_mean(s, u.value).transpose();
  const Vector normal = u.value.cwiseProduct(s.normal).rowwise().sum();
  const Vector divergence = surface_divergence(s, u) + 2.0 * s.mean_curvature.cwiseProduct(normal);
  const SphereVectors spreading = displacement_of_divergence(fine, s, s.area_element.cwiseProduct(divergence));
  return {u.value.cwiseProduct(s.dual_1).rowwise().sum() - spreading.d1,
          u.value.cwiseProduct(s.dual_2).rowwise().sum() - spreading.d2};
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

/// Unit vectors to points of the parameter sphere, [n x 3].
using Directions = Matrix;

Directions node_directions(const SphereGrid& grid) {
  Directions r(grid.n_points(), 3);
  const Vector cosines = grid.phi.array().cos(), sines = grid.phi.array().sin();
  for (Index j = 0; j < grid.n_theta; ++j) {
    const auto rows = Eigen::seqN(j * grid.n_phi, grid.n_phi);
    r(rows, 0) = std::sin(grid.theta[j]) * cosines;
    r(rows, 1) = std::sin(grid.theta[j]) * sines;
    r(rows, 2).setConstant(std::cos(grid.theta[j]));
  }
  return r;
}

/// Cartesian components, [n x 3], of vectors given along e_θ and e_φ at the nodes.
Matrix cartesian(const SphereGrid& grid, const SphereVectors& field) {
  Matrix vectors(grid.n_points(), 3);
  const Eigen::ArrayXd cosines = grid.phi.array().cos(), sines = grid.phi.array().sin();
  for (Index j = 0; j < grid.n_theta; ++j) {
    const double cos_theta = std::cos(grid.theta[j]), sin_theta = std::sin(grid.theta[j]);
    const auto rows = Eigen::seqN(j * grid.n_phi, grid.n_phi);
    const Eigen::ArrayXd along_theta = field.d1(rows), along_phi = field.d2(rows);
    vectors(rows, 0) = cos_theta * cosines * along_theta - sines * along_phi;
    vectors(rows, 1) = cos_theta * sines * along_theta + cosines * along_phi;
    vectors(rows, 2) = -sin_theta * along_theta;
  }
  return vectors;
}

/// cos √y and sin √y/√y to rounding, for squared distances y up to this.
constexpr double kShortWay2 = 0.25;
inline double cosine_of_root(double y) {
  double sum = 1.0;
  for (int k = 7; k > 0; --k) sum = 1.0 - sum * y / (2.0 * k * (2.0 * k - 1.0));
  return sum;
}
inline double sinc_of_root(double y) {
  double sum = 1.0;
  for (int k = 7; k > 0; --k) sum = 1.0 - sum * y / (2.0 * k * (2.0 * k + 1.0));
  return sum;
}

/// Points r̂ moved along great circles by the tangential part of −vector.
Directions moved_back(const Directions& r, const Matrix& vectors) {
  Directions result(r.rows(), 3);
  double longest2 = 0.0;
#pragma omp simd reduction(max : longest2)
  for (Index i = 0; i < r.rows(); ++i) {
    const double along = r(i, 0) * vectors(i, 0) + r(i, 1) * vectors(i, 1) + r(i, 2) * vectors(i, 2);
    double length2 = 0.0;
    for (Index c = 0; c < 3; ++c) {
      const double way = along * r(i, c) - vectors(i, c);
      result(i, c) = way;
      length2 += way * way;
    }
    longest2 = std::max(longest2, length2);
  }
  // Not (longest2 > …): NaN must take this branch, and stay NaN.
  if (!(longest2 <= kShortWay2)) {
    for (Index i = 0; i < r.rows(); ++i) result.row(i) = along_great_circle(r.row(i), result.row(i));
    return result;
  }
#pragma omp simd
  for (Index i = 0; i < r.rows(); ++i) {
    const double x = result(i, 0), y = result(i, 1), z = result(i, 2), length2 = x * x + y * y + z * z;
    const double cosine = cosine_of_root(length2), sinc = sinc_of_root(length2);
    result(i, 0) = cosine * r(i, 0) + sinc * x;
    result(i, 1) = cosine * r(i, 1) + sinc * y;
    result(i, 2) = cosine * r(i, 2) + sinc * z;
  }
  return result;
}

/// Cartesian components of the sliding at the midpoint of its path, which preserves areas to third order: [n x 3].
/// Degrees whose wavelength is not long against the sliding fade out.
Matrix midway_sliding(const SphereTransform& fine, const Directions& nodes, const SphereVectors& sliding) {
  const Matrix at_nodes = cartesian(fine.grid(), sliding);
  const double length = at_nodes.rowwise().norm().maxCoeff();
  // Without swirl, as in most axisymmetric runs, it is rounding.
  if (length < no_sliding) return Matrix::Zero(at_nodes.rows(), 3);
  const auto share = [&](int degree) { return 1.0 / (1.0 + std::pow(degree * length / largest_phase, phase_power)); };
  Matrix series = fine.analyze(at_nodes);
  const Matrix beyond = at_nodes - fine.synthesize(series);
  for (int n = 1; n <= fine.order(); ++n) {
    series.middleRows(coefficient_index(n, -n), 2 * n + 1) *= share(n);
  }
  const Matrix start = fine.synthesize(series);
  return evaluate_harmonics(series, moved_back(nodes, 0.5 * start), fine.azimuthal_order()) +
         share(fine.order() + 1) * beyond;
}

/// Coefficients of every column from its values at the given points.
Matrix carried_to(const SphereTransform& fine, const Matrix& columns, const Directions& from) {
  return fine.analyze(evaluate_harmonics(columns, from, fine.azimuthal_order()));
}

}  // namespace

GridMove::GridMove(const SphereTransform& fine, const Matrix& displacement, const Matrix& position) : fine_(fine) {
  const Directions nodes = node_directions(fine.grid());
  const Matrix sliding = midway_sliding(fine, nodes, sliding_part(fine, make_surface(fine, position), displacement));
  // The smoothing is that of the shape at its new nodes. At the old nodes it would be out of phase with modes whose
  // wavelength is not long against the sliding of one step, and would amplify them.
  const Matrix slid = sliding.isZero(0.0) ? position : carried_to(fine, position, moved_back(nodes, sliding));
  const SphereVectors smoothing = smoothing_gradient(fine, make_surface(fine, slid), slid);
  from_ = moved_back(nodes, sliding + cartesian(fine.grid(), smoothing));
}

Matrix GridMove::carried(const Matrix& columns) const { return carried_to(fine_, columns, from_); }

/// All fields together cost little more than one.
SurfaceFields GridMove::carried(const SurfaceFields& fields) const {
  SurfaceFields result = fields;
  const Matrix columns = carried(columns_of(fields));
  for_each_block(result, [&](auto& field, Index first) { field = columns.middleCols(first, field.cols()); });
  return result;
}

SurfaceFields remap(const SphereTransform& fine, const Matrix& displacement, const SurfaceFields& fields) {
  return GridMove(fine, displacement, fields.position).carried(fields);
}

}  // namespace vehd

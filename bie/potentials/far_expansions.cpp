#include "bie/potentials/far_expansions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/potentials/smooth_grid.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Pairs that need more are near: rows over the coefficients cost as much then.
constexpr int kHighestDegree = 16;
/// Slopes, and densities without a mean, lose so many degrees against potentials of a charge.
constexpr int kMoreDegrees = 2;
constexpr double kPi = std::numbers::pi;

}  // namespace

FarExpansions::FarExpansions(const std::vector<ExpandedMembrane>& membranes, double tolerance) : tolerance_(tolerance) {
  std::vector<Vector3> centres;
  double largest = 0.0;
  for (const ExpandedMembrane& membrane : membranes) {
    centres.emplace_back(membrane.position.row(0).transpose() / std::sqrt(4.0 * kPi));
    largest = std::max(largest, (membrane.points.rowwise() - centres.back().transpose()).rowwise().norm().maxCoeff());
  }
  scale_ = largest;
  for (int axis = 0; axis < 3; ++axis) derivative_.push_back(regular_derivative(axis, kHighestDegree));
  parity_.resize(n_solid(kHighestDegree));
  for (int l = 0; l <= kHighestDegree; ++l) {
    parity_.segment(Index{l} * l, 2 * l + 1).setConstant(l % 2 == 0 ? 1.0 : -1.0);
  }
  for (std::size_t a = 0; a < membranes.size(); ++a) places_.push_back(place_of(membranes[a], centres[a]));
  pairs_of_.resize(membranes.size());
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const int degree = degree_of(places_[a], places_[b]);
      if (degree > kHighestDegree) continue;
      pairs_of_[a].push_back(static_cast<Index>(pairs_.size()));
      pairs_of_[b].push_back(static_cast<Index>(pairs_.size()));
      pairs_.push_back({a, b, n_solid(degree), {}});
    }
  }
#pragma omp parallel for schedule(dynamic, 16)
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Pair& pair = pairs_[i];
    const int degree = static_cast<int>(std::lround(std::sqrt(static_cast<double>(pair.n)))) - 1;
    pair.to_second = moments_to_local(places_[pair.second].centre - places_[pair.first].centre, degree);
  }
}

FarExpansions::Place FarExpansions::place_of(const ExpandedMembrane& membrane, const Vector3& centre) const {
  const int order = order_of(membrane.position.rows());
  // Exact for the moments of a sphere.
  const int grid_order = order + kHighestDegree / 2;
  SphereTransform nodes(order, make_grid(grid_order, fast_longitudes(2 * grid_order + 2)));
  const SmoothGrid grid = make_smooth_grid(make_layer_fields(membrane.position, {}), nodes);
  const auto about_centre = [&](const Matrix& points) -> Matrix {
    return (points.rowwise() - centre.transpose()) / scale_;
  };
  Matrix from_centre = about_centre(grid.nodes.leftCols(3)), targets = about_centre(membrane.points);
  const double radius = std::max(from_centre.rowwise().norm().maxCoeff(), targets.rowwise().norm().maxCoeff());
  Matrix regular = regular_harmonics(from_centre, kHighestDegree);
  Matrix target_regular = regular_harmonics(targets, kHighestDegree);
  return {centre / scale_,        radius,
          std::move(nodes),       grid.weight,
          std::move(from_centre), grid.area_vectors,
          std::move(regular),     std::move(targets),
          membrane.normals,       std::move(target_regular)};
}

/// Terms of degree l of either expansion fall like the l-th power of the radius over the distance to the other surface.
int FarExpansions::degree_of(const Place& a, const Place& b) const {
  const double distance = (a.centre - b.centre).norm();
  const double ratio = std::max(b.radius / (distance - a.radius), a.radius / (distance - b.radius));
  if (!(ratio > 0.0 && ratio < 0.5)) return kHighestDegree + 1;
  return static_cast<int>(
      std::min(std::ceil(std::log(tolerance_) / std::log(ratio)) + kMoreDegrees, kHighestDegree + 1.0));
}

bool FarExpansions::is_far(std::size_t target, std::size_t source) const {
  return target != source &&
         degree_of(places_[std::min(target, source)], places_[std::max(target, source)]) <= kHighestDegree;
}

Matrix FarExpansions::dipole_moments(const Place& place, const std::vector<Matrix>& components) const {
  Matrix sums = Matrix::Zero(place.regular.cols(), components.front().cols());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sums += derivative_[axis].transpose() * Matrix(place.regular.transpose() * components[axis]);
  }
  return moments(sums);
}

std::vector<Matrix> FarExpansions::single_moments(const std::vector<Vector>& weighted) const {
  std::vector<Matrix> result(places_.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t b = 0; b < places_.size(); ++b) {
    if (weighted[b].size() == 0) continue;
    const Place& place = places_[b];
    const Vector charges = place.weight.cwiseProduct(place.nodes.synthesize(weighted[b]).col(0));
    result[b] = moments(place.regular.transpose() * charges);
  }
  return result;
}

std::vector<Matrix> FarExpansions::double_moments(const std::vector<Vector>& densities) const {
  std::vector<Matrix> result(places_.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t b = 0; b < places_.size(); ++b) {
    if (densities[b].size() == 0) continue;
    const Place& place = places_[b];
    const Vector charges = place.weight.cwiseProduct(place.nodes.synthesize(densities[b]).col(0));
    std::vector<Matrix> dipoles;
    for (int k = 0; k < 3; ++k) dipoles.emplace_back(charges.cwiseProduct(place.area_vectors.col(k)));
    result[b] = dipole_moments(place, dipoles);
  }
  return result;
}

std::vector<Matrix> FarExpansions::local(const std::vector<Matrix>& moments, bool is_stokes) const {
  const Index columns = is_stokes ? 4 : 1;
  std::vector<Matrix> result(places_.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t a = 0; a < places_.size(); ++a) {
    Matrix straight = Matrix::Zero(n_solid(kHighestDegree), columns), mirrored = straight;
    for (const Index i : pairs_of_[a]) {
      const Pair& pair = pairs_[static_cast<std::size_t>(i)];
      const bool forward = pair.second == a;
      const std::size_t b = forward ? pair.first : pair.second;
      if (moments[b].size() == 0) continue;
      Matrix source = moments[b].topRows(pair.n);
      // (x − c_b)·A = (x − c_a)·A + (c_a − c_b)·A.
      if (is_stokes) source.col(3) -= source.leftCols(3) * (places_[a].centre - places_[b].centre);
      if (forward) {
        straight.topRows(pair.n).noalias() += pair.to_second * source;
      } else {
        // Seen from the other side all odd degrees change their sign.
        source = parity_.head(pair.n).asDiagonal() * source;
        mirrored.topRows(pair.n).noalias() += pair.to_second * source;
      }
    }
    result[a] = straight + parity_.asDiagonal() * mirrored;
  }
  return result;
}

std::vector<Matrix> FarExpansions::scalar_values(const std::vector<Matrix>& moments, double factor) const {
  std::vector<Matrix> values = local(moments, false);
  for (std::size_t a = 0; a < places_.size(); ++a) values[a] = factor * (places_[a].target_regular * values[a]);
  return values;
}

std::vector<Matrix> FarExpansions::scalar_slopes(const std::vector<Matrix>& moments, double factor) const {
  std::vector<Matrix> values = local(moments, false);
  for (std::size_t a = 0; a < places_.size(); ++a) {
    const Place& place = places_[a];
    Vector slope = Vector::Zero(place.target_regular.rows());
    for (int k = 0; k < 3; ++k) {
      const Vector derivative = derivative_[static_cast<std::size_t>(k)] * values[a];
      slope += place.target_normals.col(k).cwiseProduct(place.target_regular * derivative);
    }
    values[a] = factor * slope;
  }
  return values;
}

std::vector<Matrix> FarExpansions::stokes_values(const std::vector<Matrix>& moments, double factor) const {
  std::vector<Matrix> values = local(moments, true);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t a = 0; a < places_.size(); ++a) {
    const Place& place = places_[a];
    Matrix u = place.target_regular * values[a].leftCols(3);
    for (int i = 0; i < 3; ++i) {
      const Matrix slope = place.target_regular * Matrix(derivative_[static_cast<std::size_t>(i)] * values[a]);
      u.col(i) += slope.col(3) - place.target_from_centre.cwiseProduct(slope.leftCols(3)).rowwise().sum();
    }
    values[a] = factor * u;
  }
  return values;
}

std::vector<Matrix> FarExpansions::laplace_single(const std::vector<Vector>& weighted) const {
  return scalar_values(single_moments(weighted), 1.0 / (4.0 * kPi * scale_));
}

std::vector<Matrix> FarExpansions::laplace_single_normal(const std::vector<Vector>& weighted) const {
  return scalar_slopes(single_moments(weighted), 1.0 / (4.0 * kPi * scale_ * scale_));
}

std::vector<Matrix> FarExpansions::laplace_double(const std::vector<Vector>& densities) const {
  return scalar_values(double_moments(densities), 1.0 / (4.0 * kPi * scale_ * scale_));
}

std::vector<Matrix> FarExpansions::laplace_double_normal(const std::vector<Vector>& densities) const {
  return scalar_slopes(double_moments(densities), 1.0 / (4.0 * kPi * scale_ * scale_ * scale_));
}

std::vector<Matrix> FarExpansions::stokes_single(const std::vector<Matrix>& weighted) const {
  // f_i/r + r_i r·f/r³ = A_i − x_j ∂_i A_j + ∂_i B, A = f/r, B = y·f/r.
  std::vector<Matrix> all(places_.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t b = 0; b < places_.size(); ++b) {
    if (weighted[b].size() == 0) continue;
    const Place& place = places_[b];
    Matrix charges(place.weight.size(), 4);
    charges.leftCols(3) = place.weight.asDiagonal() * place.nodes.synthesize(weighted[b]);
    charges.col(3) = place.from_centre.cwiseProduct(charges.leftCols(3)).rowwise().sum();
    all[b] = moments(place.regular.transpose() * charges);
  }
  return stokes_values(all, 1.0 / (8.0 * kPi * scale_));
}

std::vector<Matrix> FarExpansions::stokes_double(const std::vector<Matrix>& velocities) const {
  // 3 r_i r_j r_k S_jk/r⁵ = A_i − x_j ∂_i A_j + ∂_i B, A_j = S_jk ∂(1/r)/∂y_k, B = y_j A_j, S = ½(v nᵀ + n vᵀ).
  std::vector<Matrix> all(places_.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t b = 0; b < places_.size(); ++b) {
    if (velocities[b].size() == 0) continue;
    const Place& place = places_[b];
    const Matrix v = place.weight.asDiagonal() * place.nodes.synthesize(velocities[b]);
    const Matrix& n = place.area_vectors;
    std::vector<Matrix> dipoles;
    for (int k = 0; k < 3; ++k) {
      Matrix& of_axis = dipoles.emplace_back(v.rows(), 4);
      for (int j = 0; j < 3; ++j) {
        of_axis.col(j) = 0.5 * (v.col(j).cwiseProduct(n.col(k)) + n.col(j).cwiseProduct(v.col(k)));
      }
      of_axis.col(3) = place.from_centre.cwiseProduct(of_axis.leftCols(3)).rowwise().sum();
    }
    all[b] = dipole_moments(place, dipoles);
  }
  return stokes_values(all, 1.0 / (4.0 * kPi * scale_ * scale_));
}

}  // namespace vehd

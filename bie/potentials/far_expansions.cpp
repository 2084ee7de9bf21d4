#include "bie/potentials/far_expansions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "bie/potentials/smooth_grid.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Pairs that need a higher degree count as near: rows over the coefficients then cost as little.
constexpr int kHighestDegree = 24;
/// Additional degrees that slopes, and densities without a mean, need compared with the potential of a charge.
constexpr int kMoreDegrees = 2;
constexpr double kPi = std::numbers::pi;

}  // namespace

FarExpansions::FarExpansions(const std::vector<ExpandedMembrane>& membranes, double tolerance,
                             SharedTransforms& transforms, Partition partition)
    : partition_(std::move(partition)),
      tolerance_(tolerance),
      translation_(kHighestDegree),
      far_from_(membranes.size()) {
  std::vector<Vector3> centres;
  double largest = 0.0;
  for (const ExpandedMembrane& membrane : membranes) {
    centres.emplace_back(membrane.position.row(0).transpose() / std::sqrt(4.0 * kPi));
    largest = std::max(largest, (membrane.points.rowwise() - centres.back().transpose()).rowwise().norm().maxCoeff());
  }
  scale_ = largest;
  for (int axis = 0; axis < 3; ++axis) derivative_.push_back(regular_derivative(axis, kHighestDegree));
  find_places(membranes, centres, transforms);
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    if (!partition_.is_local(a)) continue;
    for (std::size_t b = 0; b < membranes.size(); ++b) {
      if (a == b) continue;
      const int degree = degree_of(places_[std::min(a, b)], places_[std::max(a, b)]);
      if (degree <= kHighestDegree) far_from_[a].push_back({b, degree});
    }
    std::ranges::stable_sort(far_from_[a], {}, &FarSource::degree);
  }
}

void FarExpansions::find_places(const std::vector<ExpandedMembrane>& membranes, const std::vector<Vector3>& centres,
                                SharedTransforms& transforms) {
  std::vector<SphereTransform> nodes;
  for (const ExpandedMembrane& membrane : membranes) {
    const int order = order_of(membrane.position.rows());
    // Exact for the moments of a sphere.
    nodes.push_back(transforms.of(order, order + kHighestDegree / 2));
  }
  std::vector<std::optional<MembraneExpansion>> places(membranes.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    if (partition_.is_local(a)) places[a] = place_of(membranes[a], centres[a], nodes[a]);
  }
  std::vector<double> radii(membranes.size());
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    if (places[a]) radii[a] = places[a]->radius;
  }
  partition_.gather(radii);
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    const MembraneExpansion of_another{centres[a] / scale_,  radii[a], nodes[a], {}, {}, {},
                                       MomentSums(Matrix()), {},       {},       {}};
    places_.push_back(places[a] ? *std::move(places[a]) : of_another);
  }
}

FarExpansions::MembraneExpansion FarExpansions::place_of(const ExpandedMembrane& membrane, const Vector3& centre,
                                                         const SphereTransform& nodes) const {
  const SmoothGrid grid = make_smooth_grid(make_layer_fields(membrane.position, {}), nodes);
  const auto about_centre = [&](const Matrix& points) -> Matrix {
    return (points.rowwise() - centre.transpose()) / scale_;
  };
  Matrix from_centre = about_centre(grid.nodes.leftCols(3)), targets = about_centre(membrane.points);
  const double radius = std::max(from_centre.rowwise().norm().maxCoeff(), targets.rowwise().norm().maxCoeff());
  MomentSums sums(regular_harmonics(from_centre, kHighestDegree));
  Matrix target_regular = regular_harmonics(targets, kHighestDegree);
  return {centre / scale_,
          radius,
          nodes,
          grid.weight,
          std::move(from_centre),
          grid.area_vectors,
          std::move(sums),
          std::move(targets),
          membrane.normals,
          std::move(target_regular)};
}

/// Terms of degree l of either expansion fall like the l-th power of the radius over the distance to the other surface.
int FarExpansions::degree_of(const MembraneExpansion& a, const MembraneExpansion& b) const {
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

Index FarExpansions::n_targets() const {
  Index n = 0;
  for (std::size_t a = 0; a < places_.size(); ++a) {
    n += places_[a].target_regular.rows() * static_cast<Index>(far_from_[a].size());
  }
  return n;
}

Matrix FarExpansions::dipole_moments(const MembraneExpansion& place, const std::vector<Matrix>& components) const {
  Matrix sums = Matrix::Zero(n_solid(kHighestDegree), components.front().cols());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sums += derivative_[axis].transpose() * place.sums.of(components[axis]);
  }
  return moments(sums);
}

Matrix FarExpansions::moments_of(PairLayer layer, const MembraneExpansion& place, const Matrix& density) const {
  const Matrix charges = place.weight.asDiagonal() * place.nodes.synthesize(density);
  const Matrix& n = place.area_vectors;
  // The last column of four is that of B, see values_of.
  const auto with_centre_sums = [&](Matrix vectors) {
    vectors.conservativeResize(vectors.rows(), 4);
    vectors.col(3) = place.from_centre.cwiseProduct(vectors.leftCols(3)).rowwise().sum();
    return vectors;
  };
  if (layer == PairLayer::laplace_single || layer == PairLayer::laplace_single_normal) {
    return moments(place.sums.of(charges));
  }
  if (layer == PairLayer::stokes_single) return moments(place.sums.of(with_centre_sums(charges)));
  std::vector<Matrix> dipoles;
  for (int k = 0; k < 3; ++k) {
    if (layer != PairLayer::stokes_double) {
      dipoles.emplace_back(charges.cwiseProduct(n.col(k)));
      continue;
    }
    Matrix of_axis(charges.rows(), 3);
    for (int j = 0; j < 3; ++j) {
      of_axis.col(j) = 0.5 * (charges.col(j).cwiseProduct(n.col(k)) + n.col(j).cwiseProduct(charges.col(k)));
    }
    dipoles.push_back(with_centre_sums(std::move(of_axis)));
  }
  return dipole_moments(place, dipoles);
}

std::vector<Matrix> FarExpansions::local(const std::vector<Matrix>& moments, bool is_stokes) const {
  std::vector<RowMatrix> turnable(places_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < places_.size(); ++b) {
    if (moments[b].size() > 0) turnable[b] = translation_.turnable(moments[b]);
  }
  partition_.gather(turnable);
  std::vector<Matrix> result(places_.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t a = 0; a < places_.size(); ++a) {
    if (!partition_.is_local(a)) continue;
    std::vector<DistantMoments> sources;
    for (const FarSource& far : far_from_[a]) {
      if (turnable[far.membrane].size() == 0) continue;
      sources.push_back({&turnable[far.membrane], places_[a].centre - places_[far.membrane].centre, far.degree});
    }
    result[a] = translation_.local(sources, is_stokes ? 4 : 1);
  }
  return result;
}

/// Stokes layers are combinations of four harmonic functions A_1, A_2, A_3, B,
///   u_i = A_i − x_j ∂_i A_j + ∂_i B,
/// x from the centre. f_i/r + r_i r·f/r³ has A = f/r, B = y·f/r; 3 r_i r_j r_k S_jk/r⁵ with S = ½(v nᵀ + n vᵀ) has
/// A_j = S_jk ∂(1/r)/∂y_k, B = y_j A_j.
Matrix FarExpansions::values_of(PairLayer layer, const MembraneExpansion& place, const Matrix& coefficients) const {
  if (is_stokes(layer)) {
    Matrix all(coefficients.rows(), 12);
    for (int i = 0; i < 3; ++i) {
      const Matrix slope = derivative_[static_cast<std::size_t>(i)] * coefficients;
      all.col(i) = coefficients.col(i) + slope.col(3);
      all.middleCols(3 + 3 * i, 3) = slope.leftCols(3);
    }
    const Matrix at_targets = place.target_regular * all;
    Matrix u = at_targets.leftCols(3);
    for (int i = 0; i < 3; ++i) {
      u.col(i) -= place.target_from_centre.cwiseProduct(at_targets.middleCols(3 + 3 * i, 3)).rowwise().sum();
    }
    return u;
  }
  if (layer == PairLayer::laplace_single || layer == PairLayer::laplace_double) {
    return place.target_regular * coefficients;
  }
  Vector slope = Vector::Zero(place.target_regular.rows());
  for (int k = 0; k < 3; ++k) {
    const Vector derivative = derivative_[static_cast<std::size_t>(k)] * coefficients;
    slope += place.target_normals.col(k).cwiseProduct(place.target_regular * derivative);
  }
  return slope;
}

std::vector<Matrix> FarExpansions::apply(PairLayer layer, const std::vector<Matrix>& densities) const {
  std::vector<Matrix> moments(places_.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t b = 0; b < places_.size(); ++b) {
    if (densities[b].size() > 0 && partition_.is_local(b)) moments[b] = moments_of(layer, places_[b], densities[b]);
  }
  // Prefactors for lengths divided by scale_.
  const double of_single = 1.0 / (4.0 * kPi * scale_);
  const std::array factors{of_single,       of_single / scale_, of_single / scale_, of_single / (scale_ * scale_),
                           0.5 * of_single, of_single / scale_};
  const double factor = factors.at(static_cast<std::size_t>(layer));
  std::vector<Matrix> values = local(moments, is_stokes(layer));
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t a = 0; a < places_.size(); ++a) {
    if (partition_.is_local(a)) values[a] = factor * values_of(layer, places_[a], values[a]);
  }
  return values;
}

}  // namespace vehd

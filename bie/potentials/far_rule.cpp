#include "bie/potentials/far_rule.hpp"

#include <algorithm>
#include <cmath>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/potentials/few_nodes.hpp"
#include "bie/potentials/smooth_grid.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// r = x − y at some nodes, y the source, and its products with J n there.
struct NodeSeparation {
  Few x, y, z, inverse;  ///< r and 1/|r|
  Few nx, ny, nz;        ///< J n(y)

  // Inlined to stay in registers; a call would pass it through memory.
  [[gnu::always_inline]] NodeSeparation(const Matrix& at, Index i, const Vector3& target)
      : x(target[0] - few(at.col(0).data() + i)),
        y(target[1] - few(at.col(1).data() + i)),
        z(target[2] - few(at.col(2).data() + i)),
        inverse(inverse_root(x * x + y * y + z * z)),
        nx(few(at.col(3).data() + i)),
        ny(few(at.col(4).data() + i)),
        nz(few(at.col(5).data() + i)) {}
  [[nodiscard]] Few source() const { return x * nx + y * ny + z * nz; }
  [[nodiscard]] Few dot(const Vector3& v) const { return x * v[0] + y * v[1] + z * v[2]; }
};

constexpr auto kSingle = [](const NodeSeparation& r) -> Few { return r.inverse; };
constexpr auto kDouble = [](const NodeSeparation& r) -> Few { return laplace_double_kernel(r.source(), r.inverse); };

struct SingleNormal {
  Vector3 normal;
  Few operator()(const NodeSeparation& r) const { return laplace_adjoint_kernel(r.dot(normal), r.inverse); }
};

struct DoubleNormal {
  Vector3 normal;
  Few operator()(const NodeSeparation& r) const {
    const Few inverse2 = r.inverse * r.inverse;
    const Few both = r.nx * normal[0] + r.ny * normal[1] + r.nz * normal[2];
    return inverse2 * r.inverse * (both - 3.0 * r.source() * r.dot(normal) * inverse2);
  }
};

constexpr auto kStokeslet =
    [](const NodeSeparation& r, const Few& fx, const Few& fy, const Few& fz) __attribute__((always_inline)) {
  return stokeslet_flow(r.x, r.y, r.z, r.inverse, fx, fy, fz);
};
constexpr auto kStresslet =
    [](const NodeSeparation& r, const Few& vx, const Few& vy, const Few& vz) __attribute__((always_inline)) {
  return stokes_double_flow(r.x, r.y, r.z, r.source(), r.inverse, vx, vy, vz);
};

struct ImageOfForces {
  MirroredTarget mirrored;
  [[gnu::always_inline]] std::array<Few, 3> operator()(const NodeSeparation& r, const Few& fx, const Few& fy,
                                                       const Few& fz) const {
    return no_slip_flow(mirrored, r.x, r.y, r.z, r.inverse, fx, fy, fz);
  }
};

struct ImageOfVelocities {
  MirroredTarget mirrored;
  [[gnu::always_inline]] std::array<Few, 3> operator()(const NodeSeparation& r, const Few& vx, const Few& vy,
                                                       const Few& vz) const {
    return no_slip_double_flow(mirrored, r.x, r.y, r.z, r.inverse, r.nx, r.ny, r.nz, vx, vy, vz);
  }
};

/// Σ over the nodes, times the prefactor, for some targets at once: each node is then read once for all of them.
template <Index kTargets, int kComponents, class Term>
void sum_nodes(const Matrix& at, const Matrix& points, Index first, double prefactor, const Term& term,
               Matrix& result) {
  Vector3 x[kTargets];
  Few sums[kTargets][kComponents];
  for (Index t = 0; t < kTargets; ++t) {
    x[t] = points.row(first + t).transpose();
    std::fill_n(sums[t], kComponents, Few{});
  }
  for (Index i = 0; i < at.rows(); i += kTogether) {
#pragma GCC unroll 2
    for (Index t = 0; t < kTargets; ++t) {
      const std::array<Few, kComponents> terms = term(NodeSeparation(at, i, x[t]), i, first + t);
      for (std::size_t c = 0; c < kComponents; ++c) sums[t][c] += terms[c];
    }
  }
  for (Index t = 0; t < kTargets; ++t) {
    for (int c = 0; c < kComponents; ++c) result(first + t, c) = prefactor * sum(sums[t][c]);
  }
}

/// sum_nodes() for all targets, with term(separation, node, target); [n_targets x kComponents].
template <int kComponents, class Term>
Matrix node_sums(const Matrix& at, const Matrix& points, double prefactor, const Term& term) {
  constexpr Index kTargets = 2;
  Matrix result(points.rows(), kComponents);
  Index first = 0;
  for (; first + kTargets <= points.rows(); first += kTargets) {
    sum_nodes<kTargets, kComponents>(at, points, first, prefactor, term, result);
  }
  for (; first < points.rows(); ++first) sum_nodes<1, kComponents>(at, points, first, prefactor, term, result);
  return result;
}

/// Σ kernel(r) f. @param kernel  maps a target to its kernel
template <class Kernel>
Vector scalar_sums(const Matrix& at, const Matrix& points, const Matrix& charges, const Kernel& kernel) {
  const double* f = charges.data();
  return node_sums<1>(
      at, points,
      kLaplacePrefactor, [&](const NodeSeparation& r, Index i, Index target) __attribute__((always_inline)) {
        return std::array<Few, 1>{few(f + i) * kernel(target)(r)};
      });
}

/// Σ flow(r, f). @param charges  f, [n_nodes x 3] @param flow  maps a target to its flow
template <class Flow>
Matrix flow_sums(const Matrix& at, const Matrix& points, const Matrix& charges, double prefactor, const Flow& flow) {
  const double *fx = charges.col(0).data(), *fy = charges.col(1).data(), *fz = charges.col(2).data();
  return node_sums<3>(
      at, points, prefactor, [&](const NodeSeparation& r, Index i, Index target) __attribute__((always_inline)) {
        return flow(target)(r, few(fx + i), few(fy + i), few(fz + i));
      });
}

/// A kernel at the nodes, prefactor included.
template <class Kernel>
void scalar_kernels(const Matrix& at, const Vector3& target, const Kernel& kernel, double* kernels) {
  for (Index i = 0; i < at.rows(); i += kTogether) {
    store(kernels + i, kLaplacePrefactor * kernel(NodeSeparation(at, i, target)));
  }
}

/// The kernel of the Stokes double layer at the nodes: xx, xy, xz, yy, yz, zz one after another.
void stokes_double_kernels(const Matrix& at, const Vector3& target, double* kernels) {
  for (Index i = 0; i < at.rows(); i += kTogether) {
    const NodeSeparation r(at, i, target);
    const std::array<Few, 6> g = stokes_double_kernel(r.x, r.y, r.z, r.source(), r.inverse);
    for (int k = 0; k < 6; ++k) store(kernels + k * at.rows() + i, kStokesDoubleLayerPrefactor * g[k]);
  }
}

}  // namespace

FarRule::FarRule(const Matrix& position, const SphereTransform& nodes) : transform_(nodes) {
  const SmoothGrid grid = make_smooth_grid(make_layer_fields(position, {}), nodes);
  n_nodes_ = grid.n_nodes();
  // Padding nodes have weight zero.
  const Index n = kTogether * ((n_nodes_ + kTogether - 1) / kTogether);
  nodes_.resize(n, 6);
  nodes_.topRows(n_nodes_) << grid.nodes.leftCols(3), grid.area_vectors;
  nodes_.bottomRows(n - n_nodes_).rowwise() = nodes_.row(n_nodes_ - 1);
  weight_ = Vector::Zero(n);
  weight_.head(n_nodes_) = grid.weight;
}

FarRule::FarRule(const Matrix& position, int grid_order)
    : FarRule(position,
              SphereTransform(order_of(position.rows()), make_grid(grid_order, fast_longitudes(2 * grid_order + 2)))) {}

Matrix FarRule::charges(const Matrix& density) const {
  Matrix result = Matrix::Zero(weight_.size(), density.cols());
  result.topRows(n_nodes_) = weight_.head(n_nodes_).asDiagonal() * transform_.synthesize(density);
  return result;
}

Matrix FarRule::sums(PairLayer layer, const Matrix& points, const Matrix& normals, const Matrix& charges,
                     const MirrorPlane& plane) const {
  const auto scalar = [&](const auto& kernel_at) -> Matrix { return scalar_sums(nodes_, points, charges, kernel_at); };
  switch (layer) {
    case PairLayer::laplace_single:
      return scalar([](Index) { return kSingle; });
    case PairLayer::laplace_single_normal:
      return scalar([&](Index target) { return SingleNormal{normals.row(target).transpose()}; });
    case PairLayer::laplace_double:
      return scalar([](Index) { return kDouble; });
    case PairLayer::laplace_double_normal:
      return scalar([&](Index target) { return DoubleNormal{normals.row(target).transpose()}; });
    case PairLayer::stokes_single:
      return flow_sums(nodes_, points, charges, stokes_single_layer_prefactor(1.0), [](Index) { return kStokeslet; });
    case PairLayer::stokes_double:
      return flow_sums(nodes_, points, charges, kStokesDoubleLayerPrefactor, [](Index) { return kStresslet; });
    case PairLayer::no_slip_single:
      return flow_sums(nodes_, points, charges, stokes_single_layer_prefactor(1.0),
                       [&](Index target) { return ImageOfForces{plane.target(points.row(target).transpose())}; });
    case PairLayer::no_slip_double:
      break;
  }
  return flow_sums(nodes_, points, charges, kStokesDoubleLayerPrefactor,
                   [&](Index target) { return ImageOfVelocities{plane.target(points.row(target).transpose())}; });
}

Matrix FarRule::rows(PairLayer layer, const Matrix& points, const Matrix& normals) const {
  const Index n_columns = is_stokes(layer) ? 6 : 1;
  Matrix kernels(nodes_.rows(), n_columns * points.rows());
  for (Index i = 0; i < points.rows(); ++i) {
    const Vector3 point = points.row(i).transpose(), normal = normals.row(i).transpose();
    double* to = kernels.col(n_columns * i).data();
    if (layer == PairLayer::laplace_single_normal) {
      scalar_kernels(nodes_, point, SingleNormal{normal}, to);
    } else if (layer == PairLayer::laplace_double_normal) {
      scalar_kernels(nodes_, point, DoubleNormal{normal}, to);
    } else {
      stokes_double_kernels(nodes_, point, to);
    }
  }
  return transform_.analyze(kernels.topRows(n_nodes_));
}

Vector FarRule::enclosures(const Matrix& points) const {
  return sums(PairLayer::laplace_double, points, points, weight_);
}

}  // namespace vehd

#include "bie/potentials/far_rule.hpp"

#include <cmath>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Columns of positions and area vectors J n.
struct Nodes {
  const double *x, *y, *z, *nx, *ny, *nz;
  Index count;

  explicit Nodes(const SmoothGrid& grid)
      : x(grid.nodes.col(0).data()),
        y(grid.nodes.col(1).data()),
        z(grid.nodes.col(2).data()),
        nx(grid.area_vectors.col(0).data()),
        ny(grid.area_vectors.col(1).data()),
        nz(grid.area_vectors.col(2).data()),
        count(grid.n_nodes()) {}
};

/// r = x − y at one node, y the source, and its products with J n there.
struct NodeSeparation {
  double x, y, z, inverse;  ///< r and 1/|r|
  double source;            ///< r·J n(y)

  NodeSeparation(const Nodes& at, Index i, const Vector3& target)
      : x(target[0] - at.x[i]),
        y(target[1] - at.y[i]),
        z(target[2] - at.z[i]),
        inverse(1.0 / std::sqrt(x * x + y * y + z * z)),
        source(x * at.nx[i] + y * at.ny[i] + z * at.nz[i]) {}
  [[nodiscard]] double dot(const Vector3& v) const { return x * v[0] + y * v[1] + z * v[2]; }
};

constexpr auto kSingle = [](const NodeSeparation& r, Index) { return laplace_single_kernel(r.inverse); };
constexpr auto kDouble = [](const NodeSeparation& r, Index) { return laplace_double_kernel(r.source, r.inverse); };
constexpr auto kStokesSingle = [](const NodeSeparation& r) { return stokeslet(r.x, r.y, r.z, r.inverse); };
constexpr auto kStokesDouble = [](const NodeSeparation& r) {
  return stokes_double_kernel(r.x, r.y, r.z, r.source, r.inverse);
};

struct SingleNormal {
  const Vector3& normal;
  double operator()(const NodeSeparation& r, Index) const { return laplace_adjoint_kernel(r.dot(normal), r.inverse); }
};

struct DoubleNormal {
  const Nodes& at;
  const Vector3& normal;
  double operator()(const NodeSeparation& r, Index i) const {
    const double inverse2 = r.inverse * r.inverse;
    const double both = at.nx[i] * normal[0] + at.ny[i] * normal[1] + at.nz[i] * normal[2];
    return inverse2 * r.inverse * (both - 3.0 * r.source * r.dot(normal) * inverse2);
  }
};

/// Σ kernel(r, node) f over the nodes.
template <class Kernel>
double scalar_sum(const Nodes& at, const Vector3& target, const double* f, const Kernel& kernel) {
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (Index i = 0; i < at.count; ++i) sum += f[i] * kernel(NodeSeparation(at, i, target), i);
  return sum;
}

/// Σ kernel(r) f over the nodes, the kernel given as xx, xy, xz, yy, yz, zz. @param charges  [n_nodes x 3]
template <class Kernel>
Vector3 tensor_sum(const Nodes& at, const Vector3& target, const Matrix& charges, const Kernel& kernel) {
  const double *fx = charges.col(0).data(), *fy = charges.col(1).data(), *fz = charges.col(2).data();
  double sx = 0.0, sy = 0.0, sz = 0.0;
#pragma omp simd reduction(+ : sx, sy, sz)
  for (Index i = 0; i < at.count; ++i) {
    const auto g = kernel(NodeSeparation(at, i, target));
    sx += g[0] * fx[i] + g[1] * fy[i] + g[2] * fz[i];
    sy += g[1] * fx[i] + g[3] * fy[i] + g[4] * fz[i];
    sz += g[2] * fx[i] + g[4] * fy[i] + g[5] * fz[i];
  }
  return {sx, sy, sz};
}

/// Every kernel of the columns at the nodes, prefactors included, [n_nodes] behind one another.
void node_kernels(const Nodes& at, const Vector3& target, const Vector3& normal, const PairColumns& columns,
                  double* kernels) {
  const auto fill = [&](int column, const auto& kernel) {
    double* out = kernels + column * at.count;
#pragma omp simd
    for (Index i = 0; i < at.count; ++i) out[i] = kLaplacePrefactor * kernel(NodeSeparation(at, i, target), i);
  };
  const auto fill_tensor = [&](int first, double prefactor, const auto& kernel) {
    double* out = kernels + first * at.count;
#pragma omp simd
    for (Index i = 0; i < at.count; ++i) {
      const auto g = kernel(NodeSeparation(at, i, target));
      for (int k = 0; k < 6; ++k) out[k * at.count + i] = prefactor * g[k];
    }
  };
  if (columns.single >= 0) fill(columns.single, kSingle);
  if (columns.single_normal >= 0) fill(columns.single_normal, SingleNormal{normal});
  if (columns.double_layer >= 0) fill(columns.double_layer, kDouble);
  if (columns.double_normal >= 0) fill(columns.double_normal, DoubleNormal{at, normal});
  if (columns.stokes >= 0) fill_tensor(columns.stokes, stokes_single_layer_prefactor(1.0), kStokesSingle);
  if (columns.stokes_double >= 0) fill_tensor(columns.stokes_double, kStokesDoubleLayerPrefactor, kStokesDouble);
}

}  // namespace

FarRule::FarRule(const Matrix& position, int grid_order)
    : transform_(order_of(position.rows()), make_grid(grid_order, fast_longitudes(2 * grid_order + 2))),
      grid_(make_smooth_grid(make_layer_fields(position, {}), transform_)) {}

Matrix FarRule::charges(const Matrix& density) const {
  return grid_.weight.asDiagonal() * transform_.synthesize(density);
}

double FarRule::laplace_single(const Vector3& x, const Matrix& charges) const {
  return kLaplacePrefactor * scalar_sum(Nodes(grid_), x, charges.data(), kSingle);
}

double FarRule::laplace_single_normal(const Vector3& x, const Vector3& normal, const Matrix& charges) const {
  return kLaplacePrefactor * scalar_sum(Nodes(grid_), x, charges.data(), SingleNormal{normal});
}

double FarRule::laplace_double(const Vector3& x, const Matrix& charges) const {
  return kLaplacePrefactor * scalar_sum(Nodes(grid_), x, charges.data(), kDouble);
}

double FarRule::laplace_double_normal(const Vector3& x, const Vector3& normal, const Matrix& charges) const {
  const Nodes at(grid_);
  return kLaplacePrefactor * scalar_sum(at, x, charges.data(), DoubleNormal{at, normal});
}

Vector3 FarRule::stokes_single(const Vector3& x, const Matrix& charges) const {
  return stokes_single_layer_prefactor(1.0) * tensor_sum(Nodes(grid_), x, charges, kStokesSingle);
}

Vector3 FarRule::stokes_double(const Vector3& x, const Matrix& charges) const {
  return kStokesDoubleLayerPrefactor * tensor_sum(Nodes(grid_), x, charges, kStokesDouble);
}

Matrix FarRule::rows(const Matrix& points, const Matrix& normals, const PairColumns& columns) const {
  const Nodes at(grid_);
  Matrix kernels(at.count, points.rows() * columns.count);
  for (Index i = 0; i < points.rows(); ++i) {
    node_kernels(at, points.row(i).transpose(), normals.row(i).transpose(), columns,
                 kernels.col(i * columns.count).data());
  }
  // Quadrature and the adjoint of the synthesis in one.
  return transform_.analyze(kernels);
}

double FarRule::enclosure(const Vector3& x) const { return laplace_double(x, grid_.weight); }

}  // namespace vehd

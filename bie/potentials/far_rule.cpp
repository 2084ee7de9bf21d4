#include "bie/potentials/far_rule.hpp"

#include <algorithm>
#include <cmath>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/potentials/few_nodes.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// r = x − y at some nodes, y the source, and its products with J n there.
struct NodeSeparation {
  Few x, y, z, inverse;  ///< r and 1/|r|
  Few nx, ny, nz;        ///< J n(y)

  // In registers: called, it would go through memory.
  [[gnu::always_inline]] NodeSeparation(const Matrix& at, Index i, const Vector3& target)
      : x(target[0] - few(at.col(0).data() + i)),
        y(target[1] - few(at.col(1).data() + i)),
        z(target[2] - few(at.col(2).data() + i)),
        inverse((x * x + y * y + z * z).rsqrt()),
        nx(few(at.col(3).data() + i)),
        ny(few(at.col(4).data() + i)),
        nz(few(at.col(5).data() + i)) {}
  [[nodiscard]] Few source() const { return x * nx + y * ny + z * nz; }
  [[nodiscard]] Few dot(const Vector3& v) const { return x * v[0] + y * v[1] + z * v[2]; }
};

constexpr auto kSingle = [](const NodeSeparation& r) -> Few { return r.inverse; };
constexpr auto kDouble = [](const NodeSeparation& r) -> Few { return laplace_double_kernel(r.source(), r.inverse); };

struct SingleNormal {
  const Vector3& normal;
  Few operator()(const NodeSeparation& r) const { return laplace_adjoint_kernel(r.dot(normal), r.inverse); }
};

struct DoubleNormal {
  const Vector3& normal;
  Few operator()(const NodeSeparation& r) const {
    const Few inverse2 = r.inverse * r.inverse;
    const Few both = r.nx * normal[0] + r.ny * normal[1] + r.nz * normal[2];
    return inverse2 * r.inverse * (both - 3.0 * r.source() * r.dot(normal) * inverse2);
  }
};

/// Σ kernel(r) f over the nodes.
template <class Kernel>
double scalar_sum(const Matrix& at, const Vector3& target, const double* f, const Kernel& kernel) {
  Few sum = Few::Zero();
  for (Index i = 0; i < at.rows(); i += kTogether) sum += few(f + i) * kernel(NodeSeparation(at, i, target));
  return sum.sum();
}

constexpr auto kStokesSingle = [](const NodeSeparation& r, const Few& fx, const Few& fy, const Few& fz) {
  return stokeslet_flow(r.x, r.y, r.z, r.inverse, fx, fy, fz);
};
constexpr auto kStokesDouble = [](const NodeSeparation& r, const Few& vx, const Few& vy, const Few& vz) {
  return stokes_double_flow(r.x, r.y, r.z, r.source(), r.inverse, vx, vy, vz);
};

/// Σ flow(r, f) over the nodes. @param charges  f, [n_nodes x 3]
template <class Flow>
Vector3 flow_sum(const Matrix& at, const Vector3& target, const Matrix& charges, const Flow& flow) {
  const double *fx = charges.col(0).data(), *fy = charges.col(1).data(), *fz = charges.col(2).data();
  Few sx = Few::Zero(), sy = Few::Zero(), sz = Few::Zero();
  for (Index i = 0; i < at.rows(); i += kTogether) {
    const std::array<Few, 3> u = flow(NodeSeparation(at, i, target), few(fx + i), few(fy + i), few(fz + i));
    sx += u[0];
    sy += u[1];
    sz += u[2];
  }
  return {sx.sum(), sy.sum(), sz.sum()};
}

/// A kernel at the nodes, prefactor included.
template <class Kernel>
void scalar_kernels(const Matrix& at, const Vector3& target, const Kernel& kernel, double* kernels) {
  for (Index i = 0; i < at.rows(); i += kTogether) {
    Eigen::Map<Few>(kernels + i) = kLaplacePrefactor * kernel(NodeSeparation(at, i, target));
  }
}

/// That of a Stokes double layer: xx, xy, xz, yy, yz, zz behind one another.
void stokes_double_kernels(const Matrix& at, const Vector3& target, double* kernels) {
  for (Index i = 0; i < at.rows(); i += kTogether) {
    const NodeSeparation r(at, i, target);
    const std::array<Few, 6> g = stokes_double_kernel(r.x, r.y, r.z, r.source(), r.inverse);
    for (int k = 0; k < 6; ++k) Eigen::Map<Few>(kernels + k * at.rows() + i) = kStokesDoubleLayerPrefactor * g[k];
  }
}

}  // namespace

FarRule::FarRule(const Matrix& position, const SphereTransform& nodes) : transform_(nodes) {
  const SmoothGrid grid = make_smooth_grid(make_layer_fields(position, {}), nodes);
  n_nodes_ = grid.n_nodes();
  // Those that fill up the last ones have no weight.
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

double FarRule::laplace_single(const Vector3& x, const Matrix& charges) const {
  return kLaplacePrefactor * scalar_sum(nodes_, x, charges.data(), kSingle);
}

double FarRule::laplace_single_normal(const Vector3& x, const Vector3& normal, const Matrix& charges) const {
  return kLaplacePrefactor * scalar_sum(nodes_, x, charges.data(), SingleNormal{normal});
}

double FarRule::laplace_double(const Vector3& x, const Matrix& charges) const {
  return kLaplacePrefactor * scalar_sum(nodes_, x, charges.data(), kDouble);
}

double FarRule::laplace_double_normal(const Vector3& x, const Vector3& normal, const Matrix& charges) const {
  return kLaplacePrefactor * scalar_sum(nodes_, x, charges.data(), DoubleNormal{normal});
}

Vector3 FarRule::stokes_single(const Vector3& x, const Matrix& charges) const {
  return stokes_single_layer_prefactor(1.0) * flow_sum(nodes_, x, charges, kStokesSingle);
}

Vector3 FarRule::stokes_double(const Vector3& x, const Matrix& charges) const {
  return kStokesDoubleLayerPrefactor * flow_sum(nodes_, x, charges, kStokesDouble);
}

template <class Kernel>
Matrix FarRule::normal_rows(const Matrix& points, const Matrix& normals) const {
  Matrix kernels(nodes_.rows(), points.rows());
  for (Index i = 0; i < points.rows(); ++i) {
    const Vector3 normal = normals.row(i).transpose();
    scalar_kernels(nodes_, points.row(i).transpose(), Kernel{normal}, kernels.col(i).data());
  }
  return transform_.analyze(kernels.topRows(n_nodes_));
}

Matrix FarRule::single_normal_rows(const Matrix& points, const Matrix& normals) const {
  return normal_rows<SingleNormal>(points, normals);
}

Matrix FarRule::double_normal_rows(const Matrix& points, const Matrix& normals) const {
  return normal_rows<DoubleNormal>(points, normals);
}

Matrix FarRule::stokes_double_rows(const Matrix& points) const {
  Matrix kernels(nodes_.rows(), 6 * points.rows());
  for (Index i = 0; i < points.rows(); ++i) {
    stokes_double_kernels(nodes_, points.row(i).transpose(), kernels.col(6 * i).data());
  }
  return transform_.analyze(kernels.topRows(n_nodes_));
}

double FarRule::enclosure(const Vector3& x) const { return laplace_double(x, weight_); }

}  // namespace vehd

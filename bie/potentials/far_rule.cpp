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

double inverse_norm(double x, double y, double z) { return 1.0 / std::sqrt(x * x + y * y + z * z); }

}  // namespace

FarRule::FarRule(const Matrix& position, int grid_order)
    : transform_(order_of(position.rows()), make_grid(grid_order)),
      grid_(make_smooth_grid(make_layer_fields(position, {}), grid_order)) {}

Matrix FarRule::charges(const Matrix& density) const {
  return grid_.weight.asDiagonal() * transform_.synthesize(density);
}

double FarRule::laplace_single(const Vector3& x, const Matrix& charges) const {
  const Nodes at(grid_);
  const double* f = charges.data();
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (Index i = 0; i < at.count; ++i) {
    sum += f[i] * laplace_single_kernel(inverse_norm(x[0] - at.x[i], x[1] - at.y[i], x[2] - at.z[i]));
  }
  return kLaplacePrefactor * sum;
}

double FarRule::laplace_single_normal(const Vector3& x, const Vector3& normal, const Matrix& charges) const {
  const Nodes at(grid_);
  const double* f = charges.data();
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (Index i = 0; i < at.count; ++i) {
    const double rx = x[0] - at.x[i], ry = x[1] - at.y[i], rz = x[2] - at.z[i];
    sum += f[i] * laplace_adjoint_kernel(rx * normal[0] + ry * normal[1] + rz * normal[2], inverse_norm(rx, ry, rz));
  }
  return kLaplacePrefactor * sum;
}

double FarRule::laplace_double(const Vector3& x, const Matrix& charges) const {
  const Nodes at(grid_);
  const double* f = charges.data();
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (Index i = 0; i < at.count; ++i) {
    const double rx = x[0] - at.x[i], ry = x[1] - at.y[i], rz = x[2] - at.z[i];
    sum += f[i] * laplace_double_kernel(rx * at.nx[i] + ry * at.ny[i] + rz * at.nz[i], inverse_norm(rx, ry, rz));
  }
  return kLaplacePrefactor * sum;
}

double FarRule::laplace_double_normal(const Vector3& x, const Vector3& normal, const Matrix& charges) const {
  const Nodes at(grid_);
  const double* f = charges.data();
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (Index i = 0; i < at.count; ++i) {
    const double rx = x[0] - at.x[i], ry = x[1] - at.y[i], rz = x[2] - at.z[i];
    const double inverse = inverse_norm(rx, ry, rz), inverse2 = inverse * inverse;
    const double source = rx * at.nx[i] + ry * at.ny[i] + rz * at.nz[i];
    const double target = rx * normal[0] + ry * normal[1] + rz * normal[2];
    const double both = at.nx[i] * normal[0] + at.ny[i] * normal[1] + at.nz[i] * normal[2];
    sum += f[i] * inverse2 * inverse * (both - 3.0 * source * target * inverse2);
  }
  return kLaplacePrefactor * sum;
}

Vector3 FarRule::stokes_single(const Vector3& x, const Matrix& charges) const {
  const Nodes at(grid_);
  const double *fx = charges.col(0).data(), *fy = charges.col(1).data(), *fz = charges.col(2).data();
  double sx = 0.0, sy = 0.0, sz = 0.0;
#pragma omp simd reduction(+ : sx, sy, sz)
  for (Index i = 0; i < at.count; ++i) {
    const double rx = x[0] - at.x[i], ry = x[1] - at.y[i], rz = x[2] - at.z[i];
    const auto g = stokeslet(rx, ry, rz, inverse_norm(rx, ry, rz));
    sx += g[0] * fx[i] + g[1] * fy[i] + g[2] * fz[i];
    sy += g[1] * fx[i] + g[3] * fy[i] + g[4] * fz[i];
    sz += g[2] * fx[i] + g[4] * fy[i] + g[5] * fz[i];
  }
  return stokes_single_layer_prefactor(1.0) * Vector3(sx, sy, sz);
}

Vector3 FarRule::stokes_double(const Vector3& x, const Matrix& charges) const {
  const Nodes at(grid_);
  const double *fx = charges.col(0).data(), *fy = charges.col(1).data(), *fz = charges.col(2).data();
  double sx = 0.0, sy = 0.0, sz = 0.0;
#pragma omp simd reduction(+ : sx, sy, sz)
  for (Index i = 0; i < at.count; ++i) {
    const double rx = x[0] - at.x[i], ry = x[1] - at.y[i], rz = x[2] - at.z[i];
    const double source = rx * at.nx[i] + ry * at.ny[i] + rz * at.nz[i];
    const auto g = stokes_double_kernel(rx, ry, rz, source, inverse_norm(rx, ry, rz));
    sx += g[0] * fx[i] + g[1] * fy[i] + g[2] * fz[i];
    sy += g[1] * fx[i] + g[3] * fy[i] + g[4] * fz[i];
    sz += g[2] * fx[i] + g[4] * fy[i] + g[5] * fz[i];
  }
  return kStokesDoubleLayerPrefactor * Vector3(sx, sy, sz);
}

double FarRule::enclosure(const Vector3& x) const { return laplace_double(x, grid_.weight); }

}  // namespace vehd

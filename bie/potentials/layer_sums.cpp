#include "bie/potentials/layer_sums.hpp"

#include <cmath>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// r = x − y at one node.
struct Separation {
  double x, y, z, inverse;
};

inline Separation separation(const Vector3& offset, const double* px, const double* py, const double* pz, Index i) {
  const double x = offset[0] - px[i];
  const double y = offset[1] - py[i];
  const double z = offset[2] - pz[i];
  return {x, y, z, 1.0 / std::sqrt(x * x + y * y + z * z)};
}

}  // namespace

void weigh_densities(const NodeColumns& columns, Index n_nodes, Index stride, double* nodes) {
  if (!columns.plain) return;
  const auto column = [&](int c) { return nodes + c * stride; };
  for (Index i = 0; i < n_nodes; ++i) {
    const auto vector = [&](int c) { return Vector3(column(c)[i], column(c + 1)[i], column(c + 2)[i]); };
    const double area = vector(columns.tangent_1).cross(vector(columns.tangent_2)).norm();
    if (columns.single >= 0) column(columns.single)[i] *= area;
    for (int c = 0; c < 3 && columns.stokes >= 0; ++c) column(columns.stokes + c)[i] *= area;
  }
}

void add_layer_sums(const NodeColumns& columns, const NodeBlock& nodes, const Vector3& offset, LayersAt& sums) {
  const double* px = nodes.column(columns.position);
  const double* py = nodes.column(columns.position + 1);
  const double* pz = nodes.column(columns.position + 2);
  const double* ux = nodes.column(columns.tangent_1);
  const double* uy = nodes.column(columns.tangent_1 + 1);
  const double* uz = nodes.column(columns.tangent_1 + 2);
  const double* vx = nodes.column(columns.tangent_2);
  const double* vy = nodes.column(columns.tangent_2 + 1);
  const double* vz = nodes.column(columns.tangent_2 + 2);
  const double* weight = nodes.weight;
  const Index n = nodes.n_nodes;

  {
    double angle = 0.0;
    double potential = 0.0;
    const double* f = columns.double_layer >= 0 ? nodes.column(columns.double_layer) : weight;
#pragma omp simd reduction(+ : angle, potential)
    for (Index i = 0; i < n; ++i) {
      const Separation r = separation(offset, px, py, pz, i);
      const double r_dot_area = r.x * (uy[i] * vz[i] - uz[i] * vy[i]) + r.y * (uz[i] * vx[i] - ux[i] * vz[i]) +
                                r.z * (ux[i] * vy[i] - uy[i] * vx[i]);
      const double kernel = weight[i] * laplace_double_kernel(r_dot_area, r.inverse);
      angle += kernel;
      potential += kernel * f[i];
    }
    sums.enclosure += angle;
    if (columns.double_layer >= 0) sums.of[LayersAt::double_layer][0] += potential;
  }
  if (columns.single >= 0) {
    const double* f = nodes.column(columns.single);
    double s = 0.0, sx = 0.0, sy = 0.0, sz = 0.0;
#pragma omp simd reduction(+ : s, sx, sy, sz)
    for (Index i = 0; i < n; ++i) {
      const Separation r = separation(offset, px, py, pz, i);
      const double charge = weight[i] * f[i] * laplace_single_kernel(r.inverse);
      const double field = charge * r.inverse * r.inverse;
      s += charge;
      sx += field * r.x;
      sy += field * r.y;
      sz += field * r.z;
    }
    sums.of[LayersAt::single][0] += s;
    if (columns.single_gradient) sums.of[LayersAt::single_gradient] -= Vector3(sx, sy, sz);
  }
  if (columns.double_1 >= 0) {
    const double* f1 = nodes.column(columns.double_1);
    const double* f2 = nodes.column(columns.double_2);
    double gx = 0.0, gy = 0.0, gz = 0.0;
#pragma omp simd reduction(+ : gx, gy, gz)
    for (Index i = 0; i < n; ++i) {
      const Separation r = separation(offset, px, py, pz, i);
      const double kernel = weight[i] * r.inverse * r.inverse * r.inverse;
      // J n×∇_γ f
      const double wx = f1[i] * vx[i] - f2[i] * ux[i];
      const double wy = f1[i] * vy[i] - f2[i] * uy[i];
      const double wz = f1[i] * vz[i] - f2[i] * uz[i];
      gx += kernel * (r.y * wz - r.z * wy);
      gy += kernel * (r.z * wx - r.x * wz);
      gz += kernel * (r.x * wy - r.y * wx);
    }
    sums.of[LayersAt::double_gradient] -= Vector3(gx, gy, gz);
  }
  if (columns.stokes >= 0) {
    const double* fx = nodes.column(columns.stokes);
    const double* fy = nodes.column(columns.stokes + 1);
    const double* fz = nodes.column(columns.stokes + 2);
    double sx = 0.0, sy = 0.0, sz = 0.0;
#pragma omp simd reduction(+ : sx, sy, sz)
    for (Index i = 0; i < n; ++i) {
      const Separation r = separation(offset, px, py, pz, i);
      const auto g = stokeslet(r.x, r.y, r.z, r.inverse);
      sx += weight[i] * (g[0] * fx[i] + g[1] * fy[i] + g[2] * fz[i]);
      sy += weight[i] * (g[1] * fx[i] + g[3] * fy[i] + g[4] * fz[i]);
      sz += weight[i] * (g[2] * fx[i] + g[4] * fy[i] + g[5] * fz[i]);
    }
    sums.of[LayersAt::stokes] += Vector3(sx, sy, sz);
  }
  if (columns.stokes_double >= 0) {
    const double* fx = nodes.column(columns.stokes_double);
    const double* fy = nodes.column(columns.stokes_double + 1);
    const double* fz = nodes.column(columns.stokes_double + 2);
    double sx = 0.0, sy = 0.0, sz = 0.0;
#pragma omp simd reduction(+ : sx, sy, sz)
    for (Index i = 0; i < n; ++i) {
      const Separation r = separation(offset, px, py, pz, i);
      const double r_dot_area = r.x * (uy[i] * vz[i] - uz[i] * vy[i]) + r.y * (uz[i] * vx[i] - ux[i] * vz[i]) +
                                r.z * (ux[i] * vy[i] - uy[i] * vx[i]);
      const auto k = stokes_double_kernel(r.x, r.y, r.z, r_dot_area, r.inverse);
      sx += weight[i] * (k[0] * fx[i] + k[1] * fy[i] + k[2] * fz[i]);
      sy += weight[i] * (k[1] * fx[i] + k[3] * fy[i] + k[4] * fz[i]);
      sz += weight[i] * (k[2] * fx[i] + k[4] * fy[i] + k[5] * fz[i]);
    }
    sums.of[LayersAt::stokes_double] += Vector3(sx, sy, sz);
  }
}

LayerFields make_layer_fields(const Matrix& position, const LayerDensities& densities) {
  require_size("position (Cartesian components)", position.cols(), 3);
  const Index n = n_coefficients(order_of(position.rows()));
  LayerFields fields;
  NodeColumns& columns = fields.columns;
  fields.coefficients = position;
  const auto append = [&](const char* what, const Matrix& density) {
    require_size(what, density.rows(), n);
    const Index first = fields.coefficients.cols();
    fields.coefficients.conservativeResize(n, first + density.cols());
    fields.coefficients.rightCols(density.cols()) = density;
    return static_cast<int>(first);
  };
  if (densities.laplace_single.size() > 0) {
    fields.single = append("density of the Laplace single layer", densities.laplace_single);
    columns.single = columns.count++;
    columns.single_gradient = densities.gradients;
  }
  columns.plain = densities.plain;
  if (densities.laplace_double.size() > 0) {
    fields.double_layer = append("density of the Laplace double layer", densities.laplace_double);
    columns.double_layer = columns.count++;
    if (densities.gradients) {
      columns.double_1 = columns.count++;
      columns.double_2 = columns.count++;
    }
  }
  if (densities.stokes_single.size() > 0) {
    require_size("density of the Stokes single layer (Cartesian components)", densities.stokes_single.cols(), 3);
    fields.stokes = append("density of the Stokes single layer", densities.stokes_single);
    columns.stokes = columns.count;
    columns.count += 3;
  }
  if (densities.stokes_double.size() > 0) {
    require_size("density of the Stokes double layer (Cartesian components)", densities.stokes_double.cols(), 3);
    fields.stokes_double = append("density of the Stokes double layer", densities.stokes_double);
    columns.stokes_double = columns.count;
    columns.count += 3;
  }
  return fields;
}

}  // namespace vehd

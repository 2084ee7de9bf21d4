#include "bie/geometry/surface.hpp"

#include <cmath>
#include <utility>

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

Vector row_dot(const Matrix& a, const Matrix& b) { return a.cwiseProduct(b).rowwise().sum(); }

/// A vector at one point: make_surface computes all fields in one vectorised loop over the points.
struct At {
  double x, y, z;
};

inline double dot(const At& a, const At& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline At cross(const At& a, const At& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline At at(const Matrix& vectors, Index i) { return {vectors(i, 0), vectors(i, 1), vectors(i, 2)}; }

inline At combined(double alpha, const At& a, double beta, const At& b) {
  return {alpha * a.x + beta * b.x, alpha * a.y + beta * b.y, alpha * a.z + beta * b.z};
}

}  // namespace

Surface make_surface(const SphereTransform& transform, const Matrix& position_coefficients) {
  require_size("position (Cartesian components)", position_coefficients.cols(), 3);
  SphereDerivatives x = transform.synthesize_hessian(position_coefficients);
  const Index n = x.value.rows();
  Surface s;
  s.position = std::move(x.value);
  s.tangent_1 = std::move(x.d1);
  s.tangent_2 = std::move(x.d2);
  for (Matrix* vectors : {&s.dual_1, &s.dual_2, &s.normal}) vectors->resize(n, 3);
  for (Vector* scalars : {&s.area_element, &s.g11, &s.g12, &s.g22, &s.b11, &s.b12, &s.b22, &s.laplace_1, &s.laplace_2,
                          &s.mean_curvature, &s.gauss_curvature}) {
    scalars->resize(n);
  }
#pragma omp simd
  for (Index i = 0; i < n; ++i) {
    const At x1 = at(s.tangent_1, i), x2 = at(s.tangent_2, i);
    const At x11 = at(x.d11, i), x12 = at(x.d12, i), x22 = at(x.d22, i);
    const At x1_x2 = cross(x1, x2);
    const double area = std::sqrt(dot(x1_x2, x1_x2)), determinant = area * area;
    const At normal{x1_x2.x / area, x1_x2.y / area, x1_x2.z / area};
    const double g11 = dot(x2, x2) / determinant, g12 = -dot(x1, x2) / determinant, g22 = dot(x1, x1) / determinant;
    const At dual_1 = combined(g11, x1, g12, x2), dual_2 = combined(g12, x1, g22, x2);
    const double b11 = dot(x11, normal), b12 = dot(x12, normal), b22 = dot(x22, normal);
    const At trace = combined(1.0, combined(g11, x11, 2.0 * g12, x12), g22, x22);
    const auto put = [i](Matrix& vectors, const At& vector) {
      vectors(i, 0) = vector.x;
      vectors(i, 1) = vector.y;
      vectors(i, 2) = vector.z;
    };
    put(s.normal, normal);
    put(s.dual_1, dual_1);
    put(s.dual_2, dual_2);
    s.area_element[i] = area;
    s.g11[i] = g11;
    s.g12[i] = g12;
    s.g22[i] = g22;
    s.b11[i] = g11 * g11 * b11 + 2.0 * g11 * g12 * b12 + g12 * g12 * b22;
    s.b12[i] = g11 * g12 * b11 + (g11 * g22 + g12 * g12) * b12 + g12 * g22 * b22;
    s.b22[i] = g12 * g12 * b11 + 2.0 * g12 * g22 * b12 + g22 * g22 * b22;
    s.laplace_1[i] = dot(trace, dual_1);
    s.laplace_2[i] = dot(trace, dual_2);
    s.mean_curvature[i] = 0.5 * (g11 * b11 + 2.0 * g12 * b12 + g22 * b22);
    s.gauss_curvature[i] = (b11 * b22 - b12 * b12) / determinant;
  }

  const SphereGrid& grid = transform.grid();
  s.quadrature.resize(grid.n_points());
  for (int j = 0; j < grid.n_theta; ++j) {
    s.quadrature.segment(j * grid.n_phi, grid.n_phi) =
        grid.weight[j] * s.area_element.segment(j * grid.n_phi, grid.n_phi);
  }
  return s;
}

Vector area_element(const SphereTransform& transform, const Matrix& position_coefficients) {
  require_size("position (Cartesian components)", position_coefficients.cols(), 3);
  const SphereDerivatives x = transform.synthesize_first_derivatives(position_coefficients);
  Vector result(x.d1.rows());
#pragma omp simd
  for (Index i = 0; i < result.size(); ++i) {
    const At x1_x2 = cross(at(x.d1, i), at(x.d2, i));
    result[i] = std::sqrt(dot(x1_x2, x1_x2));
  }
  return result;
}

Matrix surface_gradient(const Surface& surface, const SphereDerivatives& scalar) {
  return scalar.d1.col(0).asDiagonal() * surface.dual_1 + scalar.d2.col(0).asDiagonal() * surface.dual_2;
}

Vector surface_divergence(const Surface& surface, const SphereDerivatives& vector) {
  return row_dot(vector.d1, surface.dual_1) + row_dot(vector.d2, surface.dual_2);
}

Matrix surface_laplacian(const Surface& surface, const SphereDerivatives& fields) {
  return surface.g11.asDiagonal() * fields.d11 + 2.0 * (surface.g12.asDiagonal() * fields.d12) +
         surface.g22.asDiagonal() * fields.d22 - surface.laplace_1.asDiagonal() * fields.d1 -
         surface.laplace_2.asDiagonal() * fields.d2;
}

double surface_area(const Surface& surface) { return surface.quadrature.sum(); }

Vector3 surface_mean(const Surface& surface, const Matrix& values) {
  return values.transpose() * surface.quadrature / surface.quadrature.sum();
}

Vector3 centroid(const Surface& surface) { return surface_mean(surface, surface.position); }

double distance_variation(const Surface& surface) {
  const Vector distance = (surface.position.rowwise() - centroid(surface).transpose()).rowwise().norm();
  return distance.maxCoeff() - distance.minCoeff();
}

double enclosed_volume(const Surface& surface) {
  return row_dot(surface.position, surface.normal).dot(surface.quadrature) / 3.0;
}

}  // namespace vehd

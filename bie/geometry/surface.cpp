#include "bie/geometry/surface.hpp"

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

Vector row_dot(const Matrix& a, const Matrix& b) { return a.cwiseProduct(b).rowwise().sum(); }

Matrix row_cross(const Matrix& a, const Matrix& b) {
  Matrix c(a.rows(), 3);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    c.col(i) = a.col(j).cwiseProduct(b.col(k)) - a.col(k).cwiseProduct(b.col(j));
  }
  return c;
}

}  // namespace

Surface make_surface(const SphereTransform& transform, const Matrix& position_coefficients) {
  require_size("position (Cartesian components)", position_coefficients.cols(), 3);
  const SphereDerivatives x = transform.synthesize_hessian(position_coefficients);
  Surface s;
  s.position = x.value;
  s.tangent_1 = x.d1;
  s.tangent_2 = x.d2;
  const Matrix cross = row_cross(x.d1, x.d2);
  s.area_element = cross.rowwise().norm();
  s.normal = s.area_element.cwiseInverse().asDiagonal() * cross;

  const Eigen::ArrayXd e = row_dot(x.d1, x.d1);
  const Eigen::ArrayXd f = row_dot(x.d1, x.d2);
  const Eigen::ArrayXd g = row_dot(x.d2, x.d2);
  const Eigen::ArrayXd determinant = s.area_element.array().square();
  s.g11 = g / determinant;
  s.g12 = -f / determinant;
  s.g22 = e / determinant;
  s.dual_1 = s.g11.asDiagonal() * x.d1 + s.g12.asDiagonal() * x.d2;
  s.dual_2 = s.g12.asDiagonal() * x.d1 + s.g22.asDiagonal() * x.d2;

  const Eigen::ArrayXd b11 = row_dot(x.d11, s.normal);
  const Eigen::ArrayXd b12 = row_dot(x.d12, s.normal);
  const Eigen::ArrayXd b22 = row_dot(x.d22, s.normal);
  s.mean_curvature = 0.5 * (s.g11.array() * b11 + 2.0 * s.g12.array() * b12 + s.g22.array() * b22);
  s.gauss_curvature = (b11 * b22 - b12.square()) / determinant;

  const Matrix trace = s.g11.asDiagonal() * x.d11 + 2.0 * (s.g12.asDiagonal() * x.d12) + s.g22.asDiagonal() * x.d22;
  s.laplace_1 = row_dot(trace, s.dual_1);
  s.laplace_2 = row_dot(trace, s.dual_2);

  const SphereGrid& grid = transform.grid();
  s.quadrature.resize(grid.n_points());
  for (int j = 0; j < grid.n_theta; ++j) {
    s.quadrature.segment(j * grid.n_phi, grid.n_phi) =
        grid.weight[j] * s.area_element.segment(j * grid.n_phi, grid.n_phi);
  }
  return s;
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

double enclosed_volume(const Surface& surface) {
  return row_dot(surface.position, surface.normal).dot(surface.quadrature) / 3.0;
}

}  // namespace vehd

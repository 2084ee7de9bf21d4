#include "fem_check/app/surface_divergence.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "meshes/harmonic_series.hpp"

namespace vehd::fem_check {

Vector surface_divergence(const Eigen::MatrixXd& position, const Eigen::MatrixXd& velocity, const Vectors& directions) {
  const meshes::HarmonicSeries x(position), v(velocity);
  Vector result(directions.cols());
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    const Vector3 direction = directions.col(i);
    // Two tangents of the unit sphere are coordinates enough: the result depends on neither.
    Eigen::Matrix<double, 3, 2> tangents;
    tangents.col(0) = direction.unitOrthogonal();
    tangents.col(1) = direction.cross(tangents.col(0));
    const Eigen::Matrix<double, 3, 2> dx = x.gradient(direction) * tangents, dv = v.gradient(direction) * tangents;
    const Eigen::Matrix2d metric = dx.transpose() * dx;
    result[i] = (metric.inverse() * (dx.transpose() * dv)).trace();
  }
  return result;
}

}  // namespace vehd::fem_check

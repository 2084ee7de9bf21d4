#include "fem_check/app/surface_divergence.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "meshes/harmonic_series.hpp"

namespace vehd::fem_check {
namespace {

/// Calls visit(point, gradients) with ∇_γ of every column of a series, [columns x 3], at each direction.
template <typename Visit>
void for_each_gradient(const Eigen::MatrixXd& position, const Eigen::MatrixXd& fields, const Vectors& directions,
                       const Visit& visit) {
  const meshes::HarmonicSeries x(position), f(fields);
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    const Vector3 direction = directions.col(i);
    // Any two tangents of the unit sphere serve as coordinates; the result does not depend on them.
    Eigen::Matrix<double, 3, 2> tangents;
    tangents.col(0) = direction.unitOrthogonal();
    tangents.col(1) = direction.cross(tangents.col(0));
    const Eigen::Matrix<double, 3, 2> dx = x.gradient(direction) * tangents;
    const Eigen::MatrixXd df = f.gradient(direction) * tangents;
    const Eigen::Matrix2d metric = dx.transpose() * dx;
    visit(i, Eigen::MatrixXd(df * metric.inverse() * dx.transpose()));
  }
}

}  // namespace

Vector surface_divergence(const Eigen::MatrixXd& position, const Eigen::MatrixXd& velocity, const Vectors& directions) {
  Vector result(directions.cols());
  for_each_gradient(position, velocity, directions,
                    [&](Eigen::Index i, const Eigen::MatrixXd& gradients) { result[i] = gradients.trace(); });
  return result;
}

std::array<Eigen::MatrixXd, 3> surface_gradients(const Eigen::MatrixXd& position, const Eigen::MatrixXd& fields,
                                                 const Vectors& directions) {
  std::array<Eigen::MatrixXd, 3> result;
  for (Eigen::MatrixXd& component : result) component.resize(fields.cols(), directions.cols());
  for_each_gradient(position, fields, directions, [&](Eigen::Index i, const Eigen::MatrixXd& gradients) {
    for (int d = 0; d < 3; ++d) result[d].col(i) = gradients.col(d);
  });
  return result;
}

}  // namespace vehd::fem_check

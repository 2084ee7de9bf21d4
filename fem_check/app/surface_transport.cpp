#include "fem_check/app/surface_transport.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace vehd::fem_check {
namespace {

/// Maps values at the nodes to derivatives there of the interpolating polynomial.
Eigen::MatrixXd derivative_matrix(const Vector& nodes) {
  const Eigen::Index n = nodes.size();
  Vector scale = Vector::Ones(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (j != i) scale[i] *= nodes[i] - nodes[j];
    }
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (j == i) continue;
      result(i, j) = scale[i] / (scale[j] * (nodes[i] - nodes[j]));
      result(i, i) -= result(i, j);
    }
  }
  return result;
}

}  // namespace

Vector surface_transport(const SurfacePoints& rule, const Vectors& position, const Vectors& velocity,
                         const Vector& value) {
  Eigen::Index per_face = 0;
  while (per_face < rule.size() && rule.face[static_cast<std::size_t>(per_face)] == rule.face.front()) ++per_face;
  const auto m = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(per_face))));
  const Eigen::MatrixXd derivative = derivative_matrix(rule.face_coordinates.row(0).head(m));
  Vector result(rule.size());
  for (Eigen::Index begin = 0; begin < rule.size(); begin += per_face) {
    const auto derivatives = [&](const Vector& of_face) {
      const Eigen::Map<const Eigen::MatrixXd> grid(of_face.data(), m, m);
      Eigen::MatrixX2d both(per_face, 2);
      const Eigen::MatrixXd along = derivative * grid, across = grid * derivative.transpose();
      both << Eigen::Map<const Vector>(along.data(), per_face), Eigen::Map<const Vector>(across.data(), per_face);
      return both;
    };
    std::array<Eigen::MatrixX2d, 3> tangents;
    for (Eigen::Index d = 0; d < 3; ++d) {
      tangents[static_cast<std::size_t>(d)] = derivatives(position.row(d).segment(begin, per_face));
    }
    const Eigen::MatrixX2d slope = derivatives(value.segment(begin, per_face));
    for (Eigen::Index i = 0; i < per_face; ++i) {
      Eigen::Matrix<double, 3, 2> t;
      for (Eigen::Index d = 0; d < 3; ++d) t.row(d) = tangents[static_cast<std::size_t>(d)].row(i);
      // Contravariant components of w.
      const Eigen::Vector2d along = (t.transpose() * t).inverse() * (t.transpose() * velocity.col(begin + i));
      result[begin + i] = along.dot(slope.row(i));
    }
  }
  return result;
}

}  // namespace vehd::fem_check

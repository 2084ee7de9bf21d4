#include "fem_check/surface_matrices.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace vehd::fem_check {

namespace {

Eigen::MatrixXd face_mass(const FacePatch& patch, const FaceShape& shape) {
  return shape.value.transpose() * patch.weight.asDiagonal() * shape.value;
}

Eigen::MatrixXd face_stiffness(const FacePatch& patch, const FaceShape& shape) {
  const Eigen::Index n = shape.value.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (int d = 0; d < 3; ++d) {
    const Eigen::MatrixXd slope = surface_derivative(patch, shape, d);
    result += slope.transpose() * patch.weight.asDiagonal() * slope;
  }
  return result;
}

template <typename Local>
SurfaceMatrix assembled(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes,
                        const Local& local) {
  const FaceShape shape = face_shape(nodes.degree(), surface.rule());
  SurfaceAssembly assembly(nodes, nodes);
  for (int f = 0; f < nodes.n_faces(); ++f) assembly.add(f, local(surface.patch(f, positions), shape));
  return assembly.matrix();
}

}  // namespace

void SurfaceAssembly::add(int face, const Eigen::MatrixXd& local) {
  const std::vector<int>& rows = rows_.of_face(face);
  const std::vector<int>& columns = columns_.of_face(face);
  for (Eigen::Index j = 0; j < local.cols(); ++j) {
    for (Eigen::Index i = 0; i < local.rows(); ++i) entries_.emplace_back(rows[i], columns[j], local(i, j));
  }
}

SurfaceMatrix SurfaceAssembly::matrix() const {
  SurfaceMatrix result(rows_.size(), columns_.size());
  result.setFromTriplets(entries_.begin(), entries_.end());
  return result;
}

SurfaceMatrix mass_matrix(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes) {
  return assembled(surface, positions, nodes, face_mass);
}

SurfaceMatrix stiffness_matrix(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes) {
  return assembled(surface, positions, nodes, face_stiffness);
}

double largest_eigenvalue(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes) {
  const FaceShape shape = face_shape(nodes.degree(), surface.rule());
  double result = 0.0;
  for (int f = 0; f < nodes.n_faces(); ++f) {
    const FacePatch patch = surface.patch(f, positions);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        face_stiffness(patch, shape), face_mass(patch, shape), Eigen::EigenvaluesOnly);
    result = std::max(result, eigen.eigenvalues().maxCoeff());
  }
  return result;
}

Eigen::MatrixXd surface_derivative(const FacePatch& patch, const FaceShape& shape, int d) {
  const Vector first = patch.dual[0].row(d).transpose();
  const Vector second = patch.dual[1].row(d).transpose();
  return first.asDiagonal() * shape.derivative[0] + second.asDiagonal() * shape.derivative[1];
}

}  // namespace vehd::fem_check

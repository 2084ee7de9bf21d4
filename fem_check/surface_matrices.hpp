#pragma once

#include <Eigen/Sparse>

#include "fem_check/surface_elements.hpp"

namespace vehd::fem_check {

/// Matrix of two sets of nodal functions.
using SurfaceMatrix = Eigen::SparseMatrix<double>;

/// Adds up local matrices of all faces, [rows of the face x columns of the face].
class SurfaceAssembly {
 public:
  SurfaceAssembly(const FaceNodes& rows, const FaceNodes& columns) : rows_(rows), columns_(columns) {}

  void add(int face, const Eigen::MatrixXd& local);
  [[nodiscard]] SurfaceMatrix matrix() const;

 private:
  const FaceNodes& rows_;
  const FaceNodes& columns_;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// ∫ φ ψ dA of the functions of `nodes` on a surface with these positions.
SurfaceMatrix mass_matrix(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes);
/// ∫ ∇_γ φ·∇_γ ψ dA.
SurfaceMatrix stiffness_matrix(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes);
/// Bound of the eigenvalues of mass⁻¹ stiffness: the largest of any face.
double largest_eigenvalue(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes);

/// Derivatives of functions along γ, in direction d, at the points of a patch: [points x nodes].
Eigen::MatrixXd surface_derivative(const FacePatch& patch, const FaceShape& shape, int d);

}  // namespace vehd::fem_check

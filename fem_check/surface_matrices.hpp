#pragma once

#include <Eigen/Sparse>

#include "fem_check/surface_elements.hpp"

namespace vehd::fem_check {

/// Matrix between two sets of nodal functions.
using SurfaceMatrix = Eigen::SparseMatrix<double>;

/// Sums local matrices over all faces.
class SurfaceAssembly {
 public:
  SurfaceAssembly(const FaceNodes& rows, const FaceNodes& columns) : rows_(rows), columns_(columns) {}

  /// @param local  [rows of the face x columns of the face]
  void add(int face, const Eigen::MatrixXd& local);
  /// The sum, [rows x columns].
  [[nodiscard]] SurfaceMatrix matrix() const;

 private:
  const FaceNodes& rows_;
  const FaceNodes& columns_;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// ∫ φ ψ dA for the functions of `nodes` on a surface with these positions.
SurfaceMatrix mass_matrix(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes);
/// ∫ ∇_γ φ·∇_γ ψ dA.
SurfaceMatrix stiffness_matrix(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes);
/// Upper bound of the eigenvalues of mass⁻¹ stiffness: the largest eigenvalue of any face.
double largest_eigenvalue(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes);

/// Component d of the surface gradient of the nodal functions at the points of a patch: [points x nodes].
Eigen::MatrixXd surface_derivative(const FacePatch& patch, const FaceShape& shape, int d);

}  // namespace vehd::fem_check

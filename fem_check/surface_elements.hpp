#pragma once

#include <array>
#include <vector>

#include "fem_check/types.hpp"
#include "meshes/volume_mesh.hpp"

/// Finite elements on the membrane: nodal functions of any degree on the faces of γ, and an isoparametric geometry.
/// Every MPI rank stores all of it, since a surface is small compared with the volume.
namespace vehd::fem_check {

/// Continuous nodal functions of one degree on the faces of γ: Gauss–Lobatto points of every face, shared on common
/// edges. Faces and their coordinates are those of SurfacePoints.
class FaceNodes {
 public:
  /// @throws std::invalid_argument for a degree below 1 or a mesh of tetrahedra
  FaceNodes(const meshes::VolumeMesh& mesh, int degree);

  [[nodiscard]] int degree() const { return degree_; }
  /// Number of nodes on γ.
  [[nodiscard]] Eigen::Index size() const { return size_; }
  [[nodiscard]] int n_faces() const { return static_cast<int>(of_face_.size()); }
  /// Numbers of the (degree + 1)² nodes of one face, first face coordinate fastest.
  [[nodiscard]] const std::vector<int>& of_face(int face) const { return of_face_[face]; }
  /// Vesicle to whose membrane a face belongs.
  [[nodiscard]] int vesicle(int face) const { return vesicle_[face]; }

 private:
  int degree_;
  Eigen::Index size_ = 0;
  std::vector<std::vector<int>> of_face_;
  std::vector<int> vesicle_;
};

/// Nodal functions of one degree at points of the unit square: [points x nodes].
struct FaceShape {
  Eigen::MatrixXd value;
  std::array<Eigen::MatrixXd, 2> derivative;  ///< with respect to each face coordinate
};
/// Nodal functions of a degree at points of the unit square.
FaceShape face_shape(int degree, const Eigen::Matrix2Xd& points);
/// Nodes in the unit square, in the order of FaceNodes::of_face.
Eigen::Matrix2Xd face_node_points(int degree);

/// Interpolates a nodal function, [nodes of from], to the nodes of another degree on the same faces, [nodes of to].
Vector interpolated(const Vector& nodal, const FaceNodes& from, const FaceNodes& to);

/// Geometry of one face at the points of a rule.
struct FacePatch {
  std::array<Vectors, 2> tangent;  ///< t_a = ∂x/∂s_a
  std::array<Vectors, 2> dual;     ///< tᵃ with tᵃ·t_b = δᵃ_b: ∇_γ u = tᵃ ∂u/∂s_a
  Vectors normal;                  ///< outward unit normal
  Vector weight;                   ///< ∫ f dA = Σ f weight
};

/// γ as an isoparametric surface of one degree, with a Gauss rule on every face. The nodes lie on the shape; all
/// geometric quantities are functions of their positions, so that the surface can be varied.
class SurfaceElements {
 public:
  SurfaceElements(const meshes::VolumeMesh& mesh, int degree, int points_per_edge);

  [[nodiscard]] const FaceNodes& nodes() const { return nodes_; }
  /// Positions of the nodes on the shape, [3 x nodes].
  [[nodiscard]] const Vectors& positions() const { return positions_; }
  /// Nodal functions of the geometry at the points of the rule.
  [[nodiscard]] const FaceShape& shape() const { return shape_; }
  /// Points of the rule in the unit square, first coordinate fastest.
  [[nodiscard]] const Eigen::Matrix2Xd& rule() const { return rule_; }
  /// Geometry of a face at the points of the rule for given positions of all nodes, [3 x nodes].
  [[nodiscard]] FacePatch patch(int face, const Vectors& positions) const;

 private:
  FaceNodes nodes_;
  Eigen::Matrix2Xd rule_;
  Vector rule_weight_;
  FaceShape shape_;
  Vectors positions_;
  std::vector<double> orientation_;  // sign of t_1 × t_2 relative to the outward normal
};

/// Values of a field at the nodes of one face, one per column.
Vectors at_nodes(const Vectors& nodal, const std::vector<int>& of_face);
/// Values of a nodal function at points of γ, [components x points].
/// @param nodal  [components x nodes]
Eigen::MatrixXd values_at(const Eigen::MatrixXd& nodal, const FaceNodes& nodes, const SurfacePoints& points);
/// Adds values at the nodes of one face, [3 x nodes of the face], to a nodal field on γ.
void add_to_nodes(const Eigen::MatrixXd& local, const std::vector<int>& of_face, Eigen::Ref<Vectors> nodal);

}  // namespace vehd::fem_check

#pragma once

#include "fem_check/cell_loops.hpp"
#include "fem_check/surface_elements.hpp"

namespace vehd::fem_check {

/// Nodes of a handler on some faces, without repetition.
std::vector<DofIndex> nodes_on(const std::vector<OuterFace>& faces, const Space& space,
                               const dealii::DoFHandler<3>& handler);

/// Nodes of a handler's scalar element on the outer sphere, and integrals over the sphere. Lengths in units of the
/// space.
class OuterSphere {
 public:
  /// @param space, handler  must outlive this object
  OuterSphere(const Space& space, const dealii::DoFHandler<3>& handler);

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(dofs_.size()); }
  [[nodiscard]] const std::vector<DofIndex>& dofs() const { return dofs_; }
  /// Positions of the nodes in the user's units.
  [[nodiscard]] Vectors positions() const;

  /// ∫ u w dA
  [[nodiscard]] const Eigen::SparseMatrix<double>& mass() const { return mass_; }
  /// ∫ w (n_b ∂_a u − n_a ∂_b u) dA, derivatives along the sphere: antisymmetric. On a half sphere this omits a
  /// multiple of ∮ (w × u)·dl over the rim, summed over all pairs of components; it vanishes for flows along a wall.
  [[nodiscard]] Eigen::SparseMatrix<double> rotation(unsigned a, unsigned b) const;
  /// ∫ f w dA for every node, [size()], f a function of positions in the user's units.
  [[nodiscard]] Vector integrate(const std::function<double(const Vector3&)>& f) const;
  /// ∫ f w dA for many functions f, [size() x functions].
  /// @param values  [functions x points] at given positions
  [[nodiscard]] Eigen::MatrixXd moments(const std::function<Eigen::MatrixXd(const Vectors&)>& values) const;

 private:
  struct Face {
    std::vector<int> nodes;       // first face coordinate fastest
    std::array<Vectors, 2> dual;  // gradients of the face coordinates along the sphere
    Vectors normal;
    Vectors position;
    Vector weight;
  };
  template <typename Local>
  [[nodiscard]] Eigen::SparseMatrix<double> assemble(const Local& local) const;

  const Space& space_;
  const dealii::DoFHandler<3>& handler_;
  std::vector<DofIndex> dofs_;
  FaceShape shape_;  // nodal functions of a face at its points
  std::vector<Face> faces_;
  Eigen::SparseMatrix<double> mass_;
};

/// Coupling of two components of a field: the matrix C in the rows of the first and the columns of the second, Cᵀ in
/// the rows of the second and the columns of the first.
struct ComponentCoupling {
  unsigned first, second;
  Eigen::SparseMatrix<double> matrix;
};

/// A symmetric matrix on few degrees of freedom of one or more components: those on γ and on the outer sphere. The
/// nodes can belong to different ranks: every rank gathers all their values and computes its own rows.
class SurfaceTerms {
 public:
  /// @param dofs       nodes
  /// @param matrix     for each component, [dofs x dofs], symmetric
  /// @param couplings  [dofs x dofs]
  SurfaceTerms(const Space& space, const dealii::DoFHandler<3>& handler, const Constraints& constraints,
               std::vector<DofIndex> dofs, Eigen::SparseMatrix<double> matrix,
               std::vector<ComponentCoupling> couplings = {});

  /// to += (matrix and couplings) · from, one vector per component. Fixed and tied nodes are left out.
  void add(const std::vector<Distributed*>& to, const std::vector<const Distributed*>& from) const;
  /// Adds the diagonal of the matrix of one component.
  void add_diagonal(Distributed& diagonal) const;
  [[nodiscard]] const std::vector<DofIndex>& dofs() const { return dofs_; }
  [[nodiscard]] const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  MPI_Comm communicator_;
  std::vector<DofIndex> dofs_;
  Eigen::SparseMatrix<double> matrix_;
  std::vector<std::size_t> own_;  // indices of the free nodes of this rank
  struct OneWay {
    unsigned to, from;
    Eigen::SparseMatrix<double> transposed;  // its columns are the rows of the coupling
  };
  std::vector<OneWay> couplings_;
};

/// Nodal values of all degrees of freedom, on all ranks.
dealii::Vector<double> on_all_ranks(const Distributed& vector, MPI_Comm communicator);

/// Interpolates a function from the nodes of one handler to those of another one, of any degree on the same cells.
/// Fixed and tied nodes are skipped.
/// @param nodal  values on all ranks
void interpolate(const dealii::DoFHandler<3>& from, const dealii::Vector<double>& nodal,
                 const dealii::DoFHandler<3>& to_handler, const Constraints& constraints, Distributed& to);

}  // namespace vehd::fem_check

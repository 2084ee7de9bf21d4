#include "fem_check/surface_projection.hpp"

#include <string>

#include "fem_check/deal_ii.hpp"

namespace vehd::fem_check {

namespace {

constexpr unsigned most_steps = 200;
/// Relative residual in the recursion of conjugate gradients, which rounding does not limit.
constexpr double reduction = 1e-16;

/// Three components per node of a nodal field, contiguous.
using NodalValues = dealii::LinearAlgebra::distributed::Vector<double>;

}  // namespace

/// u ↦ ∫ u·φ dA, component by component.
class SurfaceProjection::Mass {
 public:
  explicit Mass(const SurfaceProjection& of) : of_(of) {}

  void vmult(NodalValues& to, const NodalValues& from) const {
    const Eigen::Index n = of_.nodes_.size(), n_faces = of_.nodes_.n_faces();
    const Eigen::Map<const Vectors> u(from.begin(), 3, n);
    Eigen::MatrixXd local(of_.value_.cols(), 3 * n_faces);
    for (Eigen::Index f = 0; f < n_faces; ++f) {
      local.middleCols(3 * f, 3) = u(Eigen::all, of_.nodes_.of_face(static_cast<int>(f))).transpose();
    }
    Eigen::MatrixXd at_points = of_.value_ * local;
    for (Eigen::Index f = 0; f < n_faces; ++f) {
      at_points.middleCols(3 * f, 3).array().colwise() *= of_.weight_.col(f).array();
    }
    local.noalias() = of_.value_.transpose() * at_points;
    Eigen::Map<Vectors> result(to.begin(), 3, n);
    result.setZero();
    for (Eigen::Index f = 0; f < n_faces; ++f) {
      add_to_nodes(local.middleCols(3 * f, 3).transpose(), of_.nodes_.of_face(static_cast<int>(f)), result);
    }
  }

 private:
  const SurfaceProjection& of_;
};

SurfaceProjection::SurfaceProjection(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes)
    : nodes_(nodes),
      value_(face_shape(nodes.degree(), surface.rule()).value),
      weight_(value_.rows(), nodes.n_faces()),
      diagonal_(Vector::Zero(nodes.size())) {
  const Eigen::MatrixXd squares = value_.cwiseAbs2();
  for (int f = 0; f < nodes.n_faces(); ++f) {
    weight_.col(f) = surface.patch(f, positions).weight;
    diagonal_(nodes.of_face(f)) += squares.transpose() * weight_.col(f);
  }
}

Vectors SurfaceProjection::solve(const Vectors& functional) const {
  const auto size = static_cast<NodalValues::size_type>(functional.size());
  NodalValues right_side(size), solution(size);
  Eigen::Map<Vectors>(right_side.begin(), 3, functional.cols()) = functional;
  dealii::DiagonalMatrix<NodalValues> preconditioner;
  preconditioner.get_vector().reinit(size);
  Eigen::Map<Vectors>(preconditioner.get_vector().begin(), 3, functional.cols()) =
      diagonal_.cwiseInverse().transpose().replicate(3, 1);
  dealii::ReductionControl control(most_steps, 0.0, reduction);
  dealii::SolverCG<NodalValues> solver(control);
  try {
    solver.solve(Mass(*this), solution, right_side, preconditioner);
  } catch (const dealii::SolverControl::NoConvergence&) {
    throw SolveError("the projection on functions of degree " + std::to_string(nodes_.degree()) +
                     " of the membrane did not converge");
  }
  return Eigen::Map<const Vectors>(solution.begin(), 3, functional.cols());
}

}  // namespace vehd::fem_check

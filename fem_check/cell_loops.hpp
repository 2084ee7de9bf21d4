#pragma once

#include <memory>

#include "fem_check/per_vesicle.hpp"
#include "fem_check/space.hpp"

namespace vehd::fem_check {

/// A vector distributed over the ranks, with the entries of neighbouring ranks that cell loops read.
using Distributed = dealii::LinearAlgebra::distributed::Vector<double>;
/// Which degrees of freedom are tied or fixed.
using Constraints = dealii::AffineConstraints<double>;
/// Loops over the cells of this rank, several cells at once.
using CellLoops = dealii::MatrixFree<3, double, Lanes>;
/// Cells of one call of the work of a loop.
using CellRange = std::pair<unsigned, unsigned>;

/// Gauss points per direction and cell of every integral of elements of a degree.
constexpr int points_per_direction(int degree) { return degree + 2; }

/// Gauss points per direction and cell of forms that only precondition: as many as nodes.
constexpr int preconditioner_points_per_direction(int degree) { return degree + 1; }

/// A finite-element space of the loops.
struct CellField {
  const dealii::DoFHandler<3>* dofs;
  const Constraints* constraints;
};

/// Loops over the fields, with Gauss points per direction.
std::shared_ptr<const CellLoops> make_cell_loops(const Space& space, const std::vector<CellField>& fields,
                                                 int n_points);

/// One number per cell, for every group of cells that the loops work on at once.
dealii::AlignedVector<Lanes> per_cell(const Space& space, const CellLoops& loops, const PerVesicle<double>& inside,
                                      double outside);

/// Diagonal of Σ_q value(q) φ_i(q)² or of Σ_q ∇φ_i · tensor(q) ∇φ_i over one group of cells, by sums over one
/// direction after the other. Shape functions and points are numbered with the first direction fastest.
class CellDiagonal {
 public:
  CellDiagonal(int degree, int n_points);

  /// @param coefficient  one number per point
  [[nodiscard]] dealii::AlignedVector<Lanes> of_mass(const dealii::AlignedVector<Lanes>& coefficient) const;
  /// @param tensor  symmetric, entries 00, 11, 22, 01, 02, 12 of all points
  [[nodiscard]] dealii::AlignedVector<Lanes> of_stiffness(
      const std::array<dealii::AlignedVector<Lanes>, 6>& tensor) const;

 private:
  // For every 1D shape function (row) at every 1D point: φ², φ φ', φ'².
  std::array<Eigen::MatrixXd, 3> products_;
};

}  // namespace vehd::fem_check

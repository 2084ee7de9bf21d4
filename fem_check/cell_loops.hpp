#pragma once

#include <memory>

#include "fem_check/per_vesicle.hpp"
#include "fem_check/space.hpp"

namespace vehd::fem_check {

/// A vector distributed over the ranks, including the entries of other ranks that the cell loops read.
using Distributed = dealii::LinearAlgebra::distributed::Vector<double>;
/// Constraints on degrees of freedom: tied to others, or fixed.
using Constraints = dealii::AffineConstraints<double>;
/// Loops over the cells of this rank, several cells at once.
using CellLoops = dealii::MatrixFree<3, double, Lanes>;
/// Range of cell groups for which a loop calls its function once.
using CellRange = std::pair<unsigned, unsigned>;

/// Gauss points per direction and cell for all integrals with elements of a degree.
constexpr int points_per_direction(int degree) { return degree + 2; }

/// Gauss points per direction and cell for forms that only precondition: as many as nodes.
constexpr int preconditioner_points_per_direction(int degree) { return degree + 1; }

/// A finite-element space on which the loops work.
struct CellField {
  const dealii::DoFHandler<3>* dofs;
  const Constraints* constraints;
};

/// Loops over the cells for these fields, with n_points Gauss points per direction.
std::shared_ptr<const CellLoops> make_cell_loops(const Space& space, const std::vector<CellField>& fields,
                                                 int n_points);

/// One number per cell, for every group of cells that is processed at once.
dealii::AlignedVector<Lanes> per_cell(const Space& space, const CellLoops& loops, const PerVesicle<double>& inside,
                                      double outside);

/// Diagonal of Σ_q value(q) φ_i(q)² or of Σ_q ∇φ_i · tensor(q) ∇φ_i over one group of cells, by sum factorisation.
/// Shape functions and points are numbered with the first direction fastest.
class CellDiagonal {
 public:
  CellDiagonal(int degree, int n_points);

  /// @param coefficient  one value per point
  [[nodiscard]] dealii::AlignedVector<Lanes> of_mass(const dealii::AlignedVector<Lanes>& coefficient) const;
  /// @param tensor  symmetric, entries 00, 11, 22, 01, 02, 12 at all points
  [[nodiscard]] dealii::AlignedVector<Lanes> of_stiffness(
      const std::array<dealii::AlignedVector<Lanes>, 6>& tensor) const;

 private:
  // At every 1D point (column) for every 1D shape function (row): φ², φ φ', φ'².
  std::array<Eigen::MatrixXd, 3> products_;
};

}  // namespace vehd::fem_check

#pragma once

#include <vector>

#include "bie/linear/recycled_subspace.hpp"
#include "bie/linear/solve_report.hpp"

namespace vehd {

/// Solves A x = b for several right-hand sides of one operator, left-preconditioned, by generalised conjugate residuals
/// (Eisenstat, Elman and Schultz 1983). Directions are kept: each later right-hand side starts from its projection on
/// the images of all earlier directions, so that a sequence of loose solves costs little more than one tight solve.
/// Samples of a similar operator only propose directions; they do not change the equations.
/// Directions are linear combinations of proposals. As proposals become dependent, the coefficients grow, and with them
/// the difference between A x and its stored image, caused by rounding in the map. The stored coefficients bound this
/// difference: directions with a large bound are rejected, and the bound limits the error of the recursive residual.
/// Success is reported if the recursive residual plus its bound is small, otherwise only from b − A x itself.
/// Accuracy: the true residual is below the tolerance if success is reported (tests/linear/recycled_gcr_test.cpp)
class RecycledGcr {
 public:
  /// @param map             x ↦ A x of length `size`, followed by n_further entries that depend linearly on x
  /// @param preconditioner  approximate inverse of A
  /// @param known           samples of an operator similar to A
  RecycledGcr(LinearMap map, LinearMap preconditioner, Index size, Index n_further = 0,
              const RecycledSubspace& known = {});

  struct Solution {
    SolveReport report;        ///< with a bound of the true residual; computing b − A x counts as an iteration
    Vector x;                  ///< [size]
    Vector further;            ///< further entries of the map at x, [n_further]
    double size_of_rhs = 0.0;  ///< norm of the preconditioned right-hand side
  };
  /// @param rhs         b, [size]
  /// @param start       initial guess, [size], or empty for x = 0
  /// @param least_size  residuals are relative to the norm of the preconditioned right-hand side, or to this if larger
  Solution solve(const Vector& rhs, const Vector& start, const SolveOptions& options, double least_size = 0.0);

  /// Directions and their images under A from all solves so far.
  [[nodiscard]] RecycledSubspace found() const;
  /// Indices of the columns of `known` that are not nearly dependent on newer ones.
  [[nodiscard]] const std::vector<Index>& kept() const { return secant_.kept(); }

 private:
  struct Direction {
    Vector x;
    Vector mapped;                 ///< A x and the further entries
    Vector image;                  ///< preconditioned A x; orthonormal to those of all other directions
    Vector proposal_coefficients;  ///< its coefficients in the proposals up to its own
  };
  /// Approximate solution during the iteration.
  struct Iterate {
    Vector x;
    Vector further;
    Vector residual;               ///< preconditioned, by recurrence
    Vector proposal_coefficients;  ///< coefficients in the proposals since the recurrence started
    double rounding;               ///< error of the residual at the start of the recurrence

    [[nodiscard]] double size() const { return residual.norm(); }
    /// Is the residual b − A x itself, not yet updated by recurrence?
    [[nodiscard]] bool is_true() const { return proposal_coefficients.size() == 0; }
  };
  [[nodiscard]] Vector preconditioned(const Vector& mapped) const;
  /// Orthogonalises a proposed direction and stores it.
  /// @returns false, without storing it, if its uncertainty exceeds `allowed`
  bool add_direction(const Vector& proposal, double allowed);
  /// Adds the step along the direction that minimises the residual.
  /// @returns norm of the part removed over the norm of the residual before
  double subtract_component(const Direction& direction, Iterate& iterate) const;
  /// Bound of the rounding error of a combination of proposals with these coefficients.
  [[nodiscard]] double uncertainty(const Vector& proposal_coefficients) const;
  /// Adds directions until the residual is at most `wanted`, `most` iterations are reached or none is accepted.
  /// @param allowed  largest uncertainty of a direction
  void search(double wanted, int most, double allowed, Iterate& iterate, int& iterations);
  /// Replaces the recursive residual by b − A x.
  void recompute_residual(const Vector& goal, Iterate& iterate) const;

  LinearMap map_;
  LinearMap preconditioner_;
  Index size_;
  Index n_further_;
  SecantInverse secant_;
  std::vector<Direction> directions_;
  std::vector<double> rounding_;  ///< error of the image of each proposal
};

}  // namespace vehd

#pragma once

#include <vector>

#include "bie/linear/recycled_subspace.hpp"
#include "bie/linear/solve_report.hpp"

namespace vehd {

/// Solves A x = b for several right-hand sides of one operator, left-preconditioned, by generalised conjugate residuals
/// (Eisenstat, Elman and Schultz 1983). Directions are kept: each later right-hand side starts from its projection on
/// the images of all earlier directions, so that a sequence of loose solves costs little more than one tight solve.
/// Samples of a similar operator propose directions and do not change the equations.
///
/// Directions are combinations of proposals. Their coefficients grow as proposals become dependent, and so does the
/// difference, from rounding of the map, between A x and the image that is stored. The coefficients are stored as well:
/// they bound that difference, which excludes proposals that are too dependent and bounds the error of the residual's
/// recurrence. Success is reported if the residual plus this bound is small, and otherwise only from b − A x itself.
/// Accuracy: the true residual is below the tolerance wherever success is reported (tests/linear/recycled_gcr_test.cpp)
class RecycledGcr {
 public:
  /// @param map             x ↦ A x of length `size`, followed by n_further entries that depend linearly on x
  /// @param preconditioner  approximate inverse of A
  /// @param known           of an operator similar to A
  RecycledGcr(LinearMap map, LinearMap preconditioner, Index size, Index n_further = 0,
              const RecycledSubspace& known = {});

  struct Solution {
    SolveReport report;  ///< of a bound of the true residual, a look at which counts as an iteration
    Vector x;
    Vector further;            ///< the map's further entries at x
    double size_of_rhs = 0.0;  ///< norm of the preconditioned right-hand side
  };
  /// @param rhs         b, of length `size`
  /// @param start       where the solve starts, of length `size`, or of length 0 for x = 0
  /// @param least_size  scale of residuals if the preconditioned right-hand side is smaller
  Solution solve(const Vector& rhs, const Vector& start, const SolveOptions& options, double least_size = 0.0);

  /// Directions and their images under A from all solves so far.
  [[nodiscard]] RecycledSubspace found() const;
  /// The columns of `known` that are not nearly dependent on newer ones.
  [[nodiscard]] const std::vector<Index>& kept() const { return secant_.kept(); }

 private:
  struct Direction {
    Vector x;
    Vector mapped;  ///< A x and the further entries
    Vector image;   ///< preconditioned A x; orthonormal to those of all other directions
    Vector shares;  ///< of the proposals up to its own that it is made of
  };
  /// An approximate solution on its way.
  struct Iterate {
    Vector x;
    Vector further;
    Vector residual;  ///< preconditioned, by recurrence
    Vector shares;    ///< of the proposals since the recurrence started
    double rounding;  ///< of the residual where the recurrence started

    [[nodiscard]] double size() const { return residual.norm(); }
    /// The recurrence has not started.
    [[nodiscard]] bool is_true() const { return shares.size() == 0; }
  };
  [[nodiscard]] Vector preconditioned(const Vector& mapped) const;
  /// Orthogonalises a proposed direction and stores it.
  /// @returns false where it would be more uncertain than allowed
  bool add_direction(const Vector& proposal, double allowed);
  /// Subtracts the part along the direction from the residual.
  /// @returns its share of that
  double follow(const Direction& direction, Iterate& iterate) const;
  /// How far the residual can be from the true one.
  [[nodiscard]] double uncertainty(const Vector& shares) const;
  /// New directions until the residual is as small as wanted, the iterations are used up, or none can be had.
  /// @param allowed  uncertainty of a direction
  void search(double wanted, int most, double allowed, Iterate& iterate, int& iterations);
  /// b − A x itself takes the place of the recurrence.
  void look(const Vector& goal, Iterate& iterate) const;

  LinearMap map_;
  LinearMap preconditioner_;
  Index size_;
  Index n_further_;
  SecantInverse secant_;
  std::vector<Direction> directions_;
  std::vector<double> rounding_;  ///< of each proposal's image
};

}  // namespace vehd

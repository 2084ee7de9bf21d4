#pragma once

#include <vector>

#include "bie/linear/recycled_subspace.hpp"
#include "bie/linear/solve_report.hpp"

namespace vehd {

/// Solves A x = b for several right-hand sides of one operator, left-preconditioned, by generalised conjugate residuals
/// (Eisenstat, Elman and Schultz 1983). Directions are kept: each later right-hand side starts from its projection on
/// what the former ones have found, so that a sequence of rough solves costs little more than one fine solve. What is
/// known of a similar operator proposes directions and does not change what is solved.
///
/// Directions are combinations of proposals with coefficients that grow as proposals become dependent, and with them
/// grows what the map's rounding leaves between A x and what is kept of it. The coefficients are carried along: they
/// tell which proposals are too dependent to be used, and how far the recurrence for the residual can be off. Success
/// is reported where the residual is small with that added, and else only of b − A x itself.
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
  /// @param start       where the solve starts, of size 0 for x = 0; options as for gmres
  /// @param least_size  scale of residuals if the preconditioned right-hand side is smaller
  Solution solve(const Vector& rhs, const Vector& start, const SolveOptions& options, double least_size = 0.0);

  /// Directions and their images under A from all solves so far.
  [[nodiscard]] RecycledSubspace learned() const;
  /// The columns of `known` that say something new.
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

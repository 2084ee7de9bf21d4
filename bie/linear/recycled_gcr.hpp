#pragma once

#include <vector>

#include "bie/linear/gmres.hpp"
#include "bie/linear/known_responses.hpp"

namespace vehd {

/// Solves A x = b for several right-hand sides of one operator, left-preconditioned, by generalised conjugate residuals
/// (Eisenstat, Elman, Schultz 1983). Directions are kept: each later right-hand side starts from its projection on what
/// the former ones have found, so that a sequence of rough solves costs little more than one fine solve. What is known
/// of a similar operator proposes directions and does not change what is solved.
class RecycledGcr {
 public:
  /// @param map             x ↦ A x of length `size`, followed by n_further entries that depend linearly on x
  /// @param preconditioner  approximate inverse of A
  /// @param known           of an operator similar to A
  RecycledGcr(LinearMap map, LinearMap preconditioner, Index size, Index n_further = 0,
              const KnownResponses& known = {});

  struct Solution {
    SolveReport report;
    Vector x;
    Vector further;  ///< the map's further entries at x
  };
  /// @param start  where the solve starts, of size 0 for x = 0; options as for gmres
  Solution solve(const Vector& rhs, const Vector& start, const GmresOptions& options);

  /// What the solves so far have found of A.
  [[nodiscard]] KnownResponses learned() const;
  /// The columns of `known` that say something new.
  [[nodiscard]] const std::vector<Index>& kept() const { return secant_.kept(); }

 private:
  struct Direction {
    Vector x;
    Vector mapped;  ///< A x and the further entries
    Vector image;   ///< preconditioned A x; orthonormal to those of all other directions
  };
  [[nodiscard]] Vector preconditioned(const Vector& mapped) const;
  [[nodiscard]] Direction direction_along(const Vector& proposal) const;
  [[nodiscard]] bool orthonormalise(Direction& direction) const;

  LinearMap map_;
  LinearMap preconditioner_;
  Index size_;
  Index n_further_;
  SecantInverse secant_;
  std::vector<Direction> directions_;
};

}  // namespace vehd

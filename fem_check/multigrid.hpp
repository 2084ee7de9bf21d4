#pragma once

#include "fem_check/stiffness.hpp"

namespace vehd::fem_check {

/// Multigrid for a scalar form: one mesh with elements of degree k, k/2, …, 1. Chebyshev polynomials of the matrix over
/// its diagonal smooth on all levels but the coarsest, whose matrix is factorised on every rank. One cycle is a
/// symmetric positive definite preconditioner.
class Multigrid {
 public:
  /// Whether finest() is also the operator of the equations and uses their quadrature. A level that only preconditions
  /// has as many points as nodes, which halves the work at k = 5.
  enum class Finest { solves, preconditions };
  Multigrid(const Space& space, const Fixed& fixed, const ScalarForm& form, Finest finest);
  ~Multigrid();

  /// Applies one cycle with zero initial guess.
  void vmult(Distributed& to, const Distributed& from) const;
  /// Operator of the elements of the space.
  [[nodiscard]] const Stiffness& finest() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vehd::fem_check

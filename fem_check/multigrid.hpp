#pragma once

#include "fem_check/stiffness.hpp"

namespace vehd::fem_check {

/// Multigrid for a scalar form: the same mesh with elements of degree k, k/2, …, 1. On every level but the last one
/// Chebyshev polynomials of the matrix over its diagonal smooth; on the last one the matrix is factorised, on every
/// rank. One cycle is a symmetric positive definite preconditioner.
class Multigrid {
 public:
  /// Whether finest() is also the operator of equations, and integrates with their points. A level that only
  /// preconditions has as many points as nodes: for k = 5 that is half of the work.
  enum class Finest { solves, preconditions };
  Multigrid(const Space& space, const Fixed& fixed, const ScalarForm& form, Finest finest);
  ~Multigrid();

  /// One cycle from zero.
  void vmult(Distributed& to, const Distributed& from) const;
  /// The operator of the elements of the space.
  [[nodiscard]] const Stiffness& finest() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vehd::fem_check

#include "fem_check/inverse_root.hpp"

#include <cmath>
#include <numbers>

namespace vehd::fem_check {

InverseRoot::InverseRoot(const Matrix& stiffness, const Matrix& mass, double smallest, double largest, Share share) {
  // Relative errors: 2 exp(−2π²/step) of the rule, (2/π) exp(−margin/2) of the truncation on either side.
  constexpr double step = 3.0;
  constexpr double margin = 6.0;
  const double first = std::log(smallest) - margin;
  const double last = std::log(largest) + margin;
  int number = 0;
  for (double t = first; t < last + step; t += step) {
    if (number++ % share.of != share.number) continue;
    weight_.push_back(step / std::numbers::pi * std::exp(0.5 * t));
    const auto& solver =
        shifted_.emplace_back(std::make_unique<Eigen::SimplicialLLT<Matrix>>(Matrix(stiffness + std::exp(t) * mass)));
    if (solver->info() != Eigen::Success) throw SolveError("a matrix of the membrane is not positive definite");
  }
}

Vector InverseRoot::apply(const Vector& x) const {
  Vector result = Vector::Zero(x.size());
  for (std::size_t j = 0; j < shifted_.size(); ++j) result += weight_[j] * shifted_[j]->solve(x);
  return result;
}

}  // namespace vehd::fem_check

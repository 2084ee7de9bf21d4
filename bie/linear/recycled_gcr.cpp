#include "bie/linear/recycled_gcr.hpp"

#include <cmath>
#include <utility>

namespace vehd {

RecycledGcr::RecycledGcr(LinearMap map, LinearMap preconditioner, Index size, Index n_further)
    : map_(std::move(map)), preconditioner_(std::move(preconditioner)), size_(size), n_further_(n_further) {}

Vector RecycledGcr::preconditioned(const Vector& mapped) const { return preconditioner_(mapped.head(size_)); }

RecycledGcr::Solution RecycledGcr::solve(const Vector& rhs, const Vector& start, const GmresOptions& options) {
  Vector residual = preconditioner_(rhs);
  const double scale = residual.norm();
  Solution solution{{true, 0, 0.0}, Vector::Zero(size_), Vector::Zero(n_further_)};
  if (scale == 0.0) return solution;
  if (start.size() > 0 && !start.isZero(0.0)) {
    const Vector mapped = map_(start);
    solution.x = start;
    solution.further = mapped.tail(n_further_);
    residual -= preconditioned(mapped);
  }

  const auto add = [&](const Direction& direction) {
    const double share = residual.dot(direction.image);
    solution.x += share * direction.x;
    solution.further += share * direction.further;
    residual -= share * direction.image;
    return share;
  };
  for (const Direction& direction : directions_) add(direction);

  int iterations = 0;
  bool stagnates = false;
  // Not (norm > …): a residual that is not a number ends the solve as well.
  while (!(residual.norm() <= options.tolerance * scale) && residual.allFinite() &&
         iterations < options.max_iterations) {
    Direction next;
    // The residual is the best direction unless the last one did not reduce it; the Krylov space grows either way.
    next.x = stagnates ? directions_.back().image : residual;
    const Vector image = map_(next.x);
    ++iterations;
    next.further = image.tail(n_further_);
    next.image = preconditioned(image);
    const double norm_before = next.image.norm();
    // Twice is enough to be orthogonal to rounding.
    for (int pass = 0; pass < 2; ++pass) {
      for (const Direction& former : directions_) {
        const double share = next.image.dot(former.image);
        next.image -= share * former.image;
        next.x -= share * former.x;
        next.further -= share * former.further;
      }
    }
    const double norm = next.image.norm();
    constexpr double kDependent = 1e-13;
    if (!(norm > kDependent * norm_before)) break;
    for (Vector* part : {&next.x, &next.further, &next.image}) *part /= norm;
    constexpr double kLeastShare = 1e-3;
    const double residual_before = residual.norm();
    directions_.push_back(std::move(next));
    stagnates = std::abs(add(directions_.back())) < kLeastShare * residual_before;
  }
  const double relative = residual.norm() / scale;
  solution.report = {relative <= options.tolerance && solution.x.allFinite(), iterations, relative};
  return solution;
}

}  // namespace vehd

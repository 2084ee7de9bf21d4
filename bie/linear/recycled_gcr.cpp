#include "bie/linear/recycled_gcr.hpp"

#include <cmath>
#include <utility>

namespace vehd {

RecycledGcr::RecycledGcr(LinearMap map, LinearMap preconditioner, Index size, Index n_further,
                         const KnownResponses& known)
    : map_(std::move(map)), preconditioner_(std::move(preconditioner)), size_(size), n_further_(n_further) {
  if (known.count() == 0) return;
  KnownResponses images{known.arguments, Matrix(size_, known.count())};
  for (Index j = 0; j < known.count(); ++j) images.responses.col(j) = preconditioner_(known.responses.col(j));
  secant_ = SecantInverse(images);
}

Vector RecycledGcr::preconditioned(const Vector& mapped) const { return preconditioner_(mapped.head(size_)); }

RecycledGcr::Direction RecycledGcr::direction_along(const Vector& proposal) const {
  Direction direction{proposal, map_(proposal), {}};
  direction.image = preconditioned(direction.mapped);
  return direction;
}

/// @returns false where the image lies in the span of the others
bool RecycledGcr::orthonormalise(Direction& direction) const {
  const double norm_before = direction.image.norm();
  // Twice is enough to be orthogonal to rounding.
  for (int pass = 0; pass < 2; ++pass) {
    for (const Direction& former : directions_) {
      const double share = direction.image.dot(former.image);
      direction.image -= share * former.image;
      direction.x -= share * former.x;
      direction.mapped -= share * former.mapped;
    }
  }
  const double norm = direction.image.norm();
  constexpr double kDependent = 1e-13;
  if (!(norm > kDependent * norm_before)) return false;
  for (Vector* part : {&direction.x, &direction.mapped, &direction.image}) *part /= norm;
  return true;
}

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

  /// @returns the share of the residual that lay along the direction
  const auto add = [&](const Direction& direction) {
    const double share = residual.dot(direction.image);
    const double of_residual = std::abs(share) / residual.norm();
    solution.x += share * direction.x;
    solution.further += share * direction.mapped.tail(n_further_);
    residual -= share * direction.image;
    return of_residual;
  };
  for (const Direction& direction : directions_) add(direction);

  // What is known of another operator may mislead: where it does, the plain residual is the next direction. That one
  // fails where A turns it by a right angle; the Krylov space then grows by the last image.
  constexpr double kMisled = 0.8;
  constexpr double kStagnates = 1e-3;
  int iterations = 0;
  bool is_proposal = false;
  double share = 1.0;
  // Not (norm > …): a residual that is not a number ends the solve as well.
  while (!(residual.norm() <= options.tolerance * scale) && residual.allFinite() &&
         iterations < options.max_iterations) {
    const bool misled = is_proposal && share < kMisled;
    const bool stagnates = !is_proposal && share < kStagnates;
    is_proposal = !misled && !stagnates && !secant_.kept().empty();
    Direction next = direction_along(stagnates ? directions_.back().image
                                     : misled  ? residual
                                               : secant_.apply(residual));
    ++iterations;
    if (!orthonormalise(next)) break;
    directions_.push_back(std::move(next));
    share = add(directions_.back());
  }
  const double relative = residual.norm() / scale;
  solution.report = {relative <= options.tolerance && solution.x.allFinite(), iterations, relative};
  return solution;
}

KnownResponses RecycledGcr::learned() const {
  const auto n = static_cast<Index>(directions_.size());
  KnownResponses result{Matrix(size_, n), Matrix(size_, n)};
  for (Index j = 0; j < n; ++j) {
    const Direction& direction = directions_[static_cast<std::size_t>(n - 1 - j)];
    result.arguments.col(j) = direction.x;
    result.responses.col(j) = direction.mapped.head(size_);
  }
  return result;
}

}  // namespace vehd

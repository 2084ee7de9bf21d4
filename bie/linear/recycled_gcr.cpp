#include "bie/linear/recycled_gcr.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bie/linear/thresholds.hpp"

namespace vehd {

RecycledGcr::RecycledGcr(LinearMap map, LinearMap preconditioner, Index size, Index n_further,
                         const RecycledSubspace& known)
    : map_(std::move(map)), preconditioner_(std::move(preconditioner)), size_(size), n_further_(n_further) {
  if (known.count() == 0) return;
  RecycledSubspace images{known.arguments, Matrix(size_, known.count())};
  for (Index j = 0; j < known.count(); ++j) images.responses.col(j) = preconditioner_(known.responses.col(j));
  secant_ = SecantInverse(images);
}

Vector RecycledGcr::preconditioned(const Vector& mapped) const { return preconditioner_(mapped.head(size_)); }

bool RecycledGcr::add_direction(const Vector& proposal, double allowed) {
  const auto n = static_cast<Index>(directions_.size());
  Direction direction{proposal, map_(proposal), {}, Vector::Unit(n + 1, n)};
  direction.image = preconditioned(direction.mapped);
  const double rounding = thresholds::map_rounding * std::max(proposal.norm(), direction.image.norm());
  // Two passes of modified Gram–Schmidt give orthogonality to rounding.
  for (int pass = 0; pass < 2; ++pass) {
    for (const Direction& former : directions_) {
      const double share = direction.image.dot(former.image);
      direction.image -= share * former.image;
      direction.x -= share * former.x;
      direction.mapped -= share * former.mapped;
      direction.proposal_coefficients.head(former.proposal_coefficients.size()) -= share * former.proposal_coefficients;
    }
  }
  const double norm = direction.image.norm();
  for (Vector* part : {&direction.x, &direction.mapped, &direction.image, &direction.proposal_coefficients})
    *part /= norm;
  rounding_.push_back(rounding);
  if (!(uncertainty(direction.proposal_coefficients) <= allowed)) {
    rounding_.pop_back();
    return false;
  }
  directions_.push_back(std::move(direction));
  return true;
}

double RecycledGcr::subtract_component(const Direction& direction, Iterate& iterate) const {
  const double share = iterate.residual.dot(direction.image);
  const double of_residual = std::abs(share) / iterate.size();
  iterate.x += share * direction.x;
  iterate.further += share * direction.mapped.tail(n_further_);
  iterate.residual -= share * direction.image;
  if (iterate.proposal_coefficients.size() < direction.proposal_coefficients.size()) {
    iterate.proposal_coefficients.conservativeResizeLike(Vector::Zero(direction.proposal_coefficients.size()));
  }
  iterate.proposal_coefficients.head(direction.proposal_coefficients.size()) += share * direction.proposal_coefficients;
  return of_residual;
}

double RecycledGcr::uncertainty(const Vector& proposal_coefficients) const {
  double sum = 0.0;
  for (Index i = 0; i < proposal_coefficients.size(); ++i)
    sum += std::abs(proposal_coefficients[i]) * rounding_[static_cast<std::size_t>(i)];
  return sum;
}

void RecycledGcr::recompute_residual(const Vector& goal, Iterate& iterate) const {
  const Vector mapped = map_(iterate.x);
  const Vector image = preconditioned(mapped);
  iterate.further = mapped.tail(n_further_);
  iterate.residual = goal - image;
  iterate.proposal_coefficients.resize(0);
  iterate.rounding = thresholds::map_rounding * std::max(iterate.x.norm(), image.norm());
}

RecycledGcr::Solution RecycledGcr::solve(const Vector& rhs, const Vector& start, const SolveOptions& options,
                                         double least_size) {
  const Vector goal = preconditioner_(rhs);
  Solution solution;
  solution.size_of_rhs = goal.norm();
  if (solution.size_of_rhs == 0.0) {
    return {{SolveEnd::converged, 0, 0.0}, Vector::Zero(size_), Vector::Zero(n_further_), 0.0};
  }
  const double scale = std::max(solution.size_of_rhs, least_size);
  Iterate iterate{Vector::Zero(size_), Vector::Zero(n_further_), goal, Vector(), 0.0};
  if (start.size() > 0 && !start.isZero(0.0)) {
    iterate.x = start;
    recompute_residual(goal, iterate);
  }
  const double wanted = options.tolerance * scale;
  int& iterations = solution.report.iterations;
  double seen = std::numeric_limits<double>::infinity();  // true residual when last computed
  bool own = directions_.empty();                         // all directions were found in this solve
  double allowed = thresholds::most_uncertain_direction;
  double size = 0.0;
  for (;;) {
    for (const Direction& direction : directions_) subtract_component(direction, iterate);
    search(wanted, options.max_iterations, allowed, iterate, iterations);
    size = iterate.size() + (iterate.is_true() ? 0.0 : iterate.rounding + uncertainty(iterate.proposal_coefficients));
    const bool exhausted = iterate.size() > wanted;
    if (size <= wanted || !std::isfinite(size) || (exhausted && iterations >= options.max_iterations)) break;
    recompute_residual(goal, iterate);
    ++iterations;
    size = iterate.size();
    if (size <= wanted) break;
    // If the true residual has not halved since it was last computed, rounding has spoilt the directions: search again
    // without them and with a tighter bound. If that fails as well, only rounding is left in the residual.
    const bool gained = size < thresholds::gain_between_looks * seen;
    if (!gained && own && allowed == thresholds::most_uncertain_after_misleading) break;
    seen = size;
    if (!gained) allowed = thresholds::most_uncertain_after_misleading;
    if (!gained || exhausted) {
      directions_.clear();
      rounding_.clear();
      own = true;
    }
  }
  solution.report.residual = size / scale;
  solution.report.end = !std::isfinite(size) || !iterate.x.allFinite() ? SolveEnd::not_finite
                        : size <= wanted                               ? SolveEnd::converged
                        : iterations >= options.max_iterations         ? SolveEnd::out_of_iterations
                                                                       : SolveEnd::stagnated;
  solution.x = std::move(iterate.x);
  solution.further = std::move(iterate.further);
  return solution;
}

void RecycledGcr::search(double wanted, int most, double allowed, Iterate& iterate, int& iterations) {
  bool is_known = false;
  double share = 1.0;
  // A residual that is not finite ends the search as well.
  while (!(iterate.size() <= wanted) && iterate.residual.allFinite() && iterations < most) {
    const bool misled = is_known && share < thresholds::least_share_of_recycled;
    const bool stagnates = !is_known && share < thresholds::least_share_of_residual;
    if (stagnates && directions_.empty()) break;
    is_known = !misled && !stagnates && !secant_.kept().empty();
    const bool added = add_direction(stagnates  ? directions_.back().image
                                     : is_known ? secant_.apply(iterate.residual)
                                                : iterate.residual,
                                     allowed);
    ++iterations;
    if (!added && stagnates) break;
    share = added ? subtract_component(directions_.back(), iterate) : 0.0;
  }
}

RecycledSubspace RecycledGcr::found() const {
  const auto n = static_cast<Index>(directions_.size());
  RecycledSubspace result{Matrix(size_, n), Matrix(size_, n)};
  for (Index j = 0; j < n; ++j) {
    const Direction& direction = directions_[static_cast<std::size_t>(n - 1 - j)];
    result.arguments.col(j) = direction.x;
    result.responses.col(j) = direction.mapped.head(size_);
  }
  return result;
}

}  // namespace vehd

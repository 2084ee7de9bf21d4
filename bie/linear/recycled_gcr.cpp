#include "bie/linear/recycled_gcr.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vehd {

namespace {

/// What the sums of a map and its preconditioner lose, relative to what they take and give: the layers sum a few
/// thousand products, and errors of either sign add up like their square root.
constexpr double map_rounding = 1e-14;

}  // namespace

RecycledGcr::RecycledGcr(LinearMap map, LinearMap preconditioner, Index size, Index n_further,
                         const KnownResponses& known)
    : map_(std::move(map)), preconditioner_(std::move(preconditioner)), size_(size), n_further_(n_further) {
  if (known.count() == 0) return;
  KnownResponses images{known.arguments, Matrix(size_, known.count())};
  for (Index j = 0; j < known.count(); ++j) images.responses.col(j) = preconditioner_(known.responses.col(j));
  secant_ = SecantInverse(images);
}

Vector RecycledGcr::preconditioned(const Vector& mapped) const { return preconditioner_(mapped.head(size_)); }

bool RecycledGcr::add_direction(const Vector& proposal, double allowed) {
  const auto n = static_cast<Index>(directions_.size());
  Direction direction{proposal, map_(proposal), {}, Vector::Unit(n + 1, n)};
  direction.image = preconditioned(direction.mapped);
  const double rounding = map_rounding * std::max(proposal.norm(), direction.image.norm());
  // Twice is enough to be orthogonal to rounding.
  for (int pass = 0; pass < 2; ++pass) {
    for (const Direction& former : directions_) {
      const double share = direction.image.dot(former.image);
      direction.image -= share * former.image;
      direction.x -= share * former.x;
      direction.mapped -= share * former.mapped;
      direction.shares.head(former.shares.size()) -= share * former.shares;
    }
  }
  const double norm = direction.image.norm();
  for (Vector* part : {&direction.x, &direction.mapped, &direction.image, &direction.shares}) *part /= norm;
  rounding_.push_back(rounding);
  if (!(uncertainty(direction.shares) <= allowed)) {
    rounding_.pop_back();
    return false;
  }
  directions_.push_back(std::move(direction));
  return true;
}

double RecycledGcr::follow(const Direction& direction, Iterate& iterate) const {
  const double share = iterate.residual.dot(direction.image);
  const double of_residual = std::abs(share) / iterate.size();
  iterate.x += share * direction.x;
  iterate.further += share * direction.mapped.tail(n_further_);
  iterate.residual -= share * direction.image;
  if (iterate.shares.size() < direction.shares.size()) {
    iterate.shares.conservativeResizeLike(Vector::Zero(direction.shares.size()));
  }
  iterate.shares.head(direction.shares.size()) += share * direction.shares;
  return of_residual;
}

double RecycledGcr::uncertainty(const Vector& shares) const {
  double sum = 0.0;
  for (Index i = 0; i < shares.size(); ++i) sum += std::abs(shares[i]) * rounding_[static_cast<std::size_t>(i)];
  return sum;
}

void RecycledGcr::look(const Vector& goal, Iterate& iterate) const {
  const Vector mapped = map_(iterate.x);
  const Vector image = preconditioned(mapped);
  iterate.further = mapped.tail(n_further_);
  iterate.residual = goal - image;
  iterate.shares.resize(0);
  iterate.rounding = map_rounding * std::max(iterate.x.norm(), image.norm());
}

RecycledGcr::Solution RecycledGcr::solve(const Vector& rhs, const Vector& start, const GmresOptions& options) {
  const Vector goal = preconditioner_(rhs);
  const double scale = goal.norm();
  if (scale == 0.0) return {{true, 0, 0.0}, Vector::Zero(size_), Vector::Zero(n_further_)};
  Iterate iterate{Vector::Zero(size_), Vector::Zero(n_further_), goal, Vector(), 0.0};
  if (start.size() > 0 && !start.isZero(0.0)) {
    iterate.x = start;
    look(goal, iterate);
  }
  const double wanted = options.tolerance * scale;
  Solution solution{{false, 0, 0.0}, {}, {}};
  int& iterations = solution.report.iterations;
  double seen = std::numeric_limits<double>::infinity();  // true residual at the last look
  bool own = directions_.empty();                         // no direction is older than this solve
  double size = 0.0;
  for (;;) {
    for (const Direction& direction : directions_) follow(direction, iterate);
    search(wanted, options.max_iterations, iterate, iterations);
    size = iterate.size() + (iterate.is_true() ? 0.0 : iterate.rounding + uncertainty(iterate.shares));
    const bool exhausted = iterate.size() > wanted;
    if (size <= wanted || !std::isfinite(size) || (exhausted && iterations >= options.max_iterations)) break;
    look(goal, iterate);
    ++iterations;
    size = iterate.size();
    if (size <= wanted) break;
    // Where a look finds no gain since the last one, the directions misled the search; where they were all found by
    // this search, it has come to what rounding leaves.
    constexpr double kWorthwhile = 0.5;
    const bool gained = size < kWorthwhile * seen;
    if (!gained && own) break;
    seen = size;
    if (!gained || exhausted) {
      directions_.clear();
      rounding_.clear();
      own = true;
    }
  }
  solution.report.residual = size / scale;
  solution.report.converged = size <= wanted && iterate.x.allFinite();
  solution.x = std::move(iterate.x);
  solution.further = std::move(iterate.further);
  return solution;
}

void RecycledGcr::search(double wanted, int most, Iterate& iterate, int& iterations) {
  // Along a proposal that shares c with the residual, √(1 − c²) of it is left. The plain residual leaves at most δ
  // where the preconditioned map is within δ of the identity. What is known of another operator may mislead: where it
  // leaves 0.6 and more, it is no better than nothing known at δ = 0.6, and the plain residual is the next direction;
  // so at most every other iteration is lost. The plain residual in turn fails where the map turns it by a right angle.
  // A share of a thousandth removes less than a millionth, which no number of iterations that anybody allows adds up to
  // a digit; the Krylov space then grows by the last image.
  constexpr double kMisled = 0.8;
  constexpr double kStagnates = 1e-3;
  // The rounding of the proposals, magnified as what they have in common is taken out, is the part of a direction's
  // image, of norm 1, that its x does not have. A step leaves that part of the residual which it claims to remove, and
  // the look at the true residual finds it: what is lost is an application, so seven digits are enough to be worth one.
  constexpr double kFewestDigits = 3e-7;
  bool is_known = false;
  double share = 1.0;
  // Not (size > …): a residual that is not a number ends the solve as well.
  while (!(iterate.size() <= wanted) && iterate.residual.allFinite() && iterations < most) {
    const bool misled = is_known && share < kMisled;
    const bool stagnates = !is_known && share < kStagnates;
    if (stagnates && directions_.empty()) break;
    is_known = !misled && !stagnates && !secant_.kept().empty();
    const bool added = add_direction(stagnates  ? directions_.back().image
                                     : is_known ? secant_.apply(iterate.residual)
                                                : iterate.residual,
                                     kFewestDigits);
    ++iterations;
    if (!added && stagnates) break;
    share = added ? follow(directions_.back(), iterate) : 0.0;
  }
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

#include "bie/fit/least_squares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <utility>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Steps of difference quotients: desired change of the model, in deviations, and limits of the step.
constexpr double wanted_change = 3.0, shortest_step = 1e-3, longest_step = 0.1;
/// Converged if a full step would lower χ² by less: a tenth of a standard error, squared.
constexpr double converged_decrease = 0.01;

/// Residuals and their difference quotients as functions of u − u(start), in the form that MINPACK requires.
class Residuals {
 public:
  explicit Residuals(const LeastSquares& problem)
      : problem_(problem),
        width_(problem.upper - problem.lower),
        most_evaluations_(12 * (static_cast<int>(width_.size()) + 2)),
        steps_((0.25 * width_).cwiseMin(longest_step)) {
    const Prediction start = evaluate({problem.start}).front();
    if (!start.values) throw InputError("the model has no value at the start: " + start.problem);
    current_ = minimum_at(problem.start, *start.values);
  }

  [[nodiscard]] Index values() const { return problem_.data.size(); }

  /// @returns -1 if no evaluation is left, which ends the search
  int operator()(const Vector& u, Vector& residuals) {
    const Vector p = p_of(u);
    if (p == current_.point) {
      residuals = current_.residuals;
      return 0;
    }
    if (n_evaluations_ >= most_evaluations_) return -1;
    const Prediction prediction = evaluate({p}).front();
    if (!prediction.values) {
      constexpr double too_far = 1e30;
      residuals = Vector::Constant(values(), too_far);
      return 0;
    }
    trial_ = minimum_at(p, *prediction.values);
    residuals = trial_.residuals;
    return 0;
  }

  /// @returns -1 at the minimum or if no evaluation is left
  int df(const Vector& u, Matrix& derivatives) {
    move_to(p_of(u));
    const Vector& p = current_.point;
    const Vector slopes = (p - problem_.lower).cwiseProduct(problem_.upper - p).cwiseQuotient(width_);
    derivatives = -current_.jacobian * slopes.asDiagonal();
    // JᵀJ may be singular: each parameter counts as known to half the width of its interval.
    Matrix normal = current_.jacobian.transpose() * current_.jacobian;
    normal.diagonal() += (2.0 * width_.cwiseInverse()).cwiseAbs2();
    const Vector gradient = current_.jacobian.transpose() * current_.residuals;
    current_.converged = gradient.dot(normal.ldlt().solve(gradient)) < converged_decrease;
    return current_.converged || n_evaluations_ >= most_evaluations_ ? -1 : 0;
  }

  /// The end of the search, with central differences.
  Minimum finish(const Vector& u, bool has_converged) {
    if (p_of(u) != current_.point) move_to(p_of(u));
    std::vector<Vector> points;
    std::vector<Index> columns;
    for (Index k = 0; k < steps_.size(); ++k) {
      if (!is_within(neighbour(k, -current_.steps[k]), k)) continue;
      points.push_back(neighbour(k, -current_.steps[k]));
      columns.push_back(k);
    }
    const std::vector<Prediction> backward = evaluate(points);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!backward[i].values) continue;
      const Index k = columns[i];
      current_.jacobian.col(k) =
          (forward_.col(k) - *backward[i].values).cwiseQuotient(2.0 * current_.steps[k] * problem_.deviations);
    }
    for (Index k = 0; k < steps_.size(); ++k) {
      const Vector slope = current_.jacobian.col(k);
      const double step = slope.dot(current_.residuals) / slope.squaredNorm();
      const bool would_leave = !is_within(neighbour(k, step), k);
      if (would_leave && (step * slope).squaredNorm() > converged_decrease) current_.at_end.push_back(k);
    }
    current_.converged = current_.converged || has_converged;
    current_.n_evaluations = n_evaluations_;
    return current_;
  }

 private:
  [[nodiscard]] Vector p_of(const Vector& u) const {
    // The formula below reproduces the start only up to rounding.
    if (u.isZero(0.0)) return problem_.start;
    const Vector ratio = (problem_.upper - problem_.start).cwiseQuotient(problem_.start - problem_.lower);
    return problem_.lower.array() + width_.array() / (1.0 + ratio.array() * (-u).array().exp());
  }

  [[nodiscard]] Minimum minimum_at(const Vector& p, const Vector& model) const {
    Minimum minimum;
    minimum.point = p;
    minimum.model = model;
    minimum.residuals = (problem_.data - model).cwiseQuotient(problem_.deviations);
    return minimum;
  }

  std::vector<Prediction> evaluate(const std::vector<Vector>& points) {
    std::vector<Prediction> predictions = problem_.model(points);
    n_evaluations_ += static_cast<int>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (predictions[i].values) least_ = std::min(least_, minimum_at(points[i], *predictions[i].values).chi2());
    }
    if (problem_.report_progress) problem_.report_progress(n_evaluations_, least_);
    return predictions;
  }

  [[nodiscard]] Vector neighbour(Index k, double step) const {
    return current_.point + step * Vector::Unit(current_.point.size(), k);
  }

  [[nodiscard]] bool is_within(const Vector& p, Index k) const {
    return p[k] >= problem_.lower[k] && p[k] <= problem_.upper[k];
  }

  /// Moves to a point if it was just tried, and takes forward differences there.
  void move_to(const Vector& p) {
    if (trial_.point.size() > 0 && p == trial_.point) current_ = trial_;
    const Index n = p.size();
    current_.steps = steps_;
    std::vector<Vector> points;
    for (Index k = 0; k < n; ++k) {
      if (!is_within(neighbour(k, steps_[k]), k)) current_.steps[k] = -steps_[k];
      points.push_back(neighbour(k, current_.steps[k]));
    }
    std::vector<Prediction> beside_it = evaluate(points);
    forward_.resize(values(), n);
    current_.jacobian.resize(values(), n);
    for (Index k = 0; k < n; ++k) {
      Prediction& prediction = beside_it[static_cast<std::size_t>(k)];
      if (!prediction.values) {
        current_.steps[k] = -current_.steps[k];
        prediction = evaluate({neighbour(k, current_.steps[k])}).front();
        if (!prediction.values) throw InputError("the model has no derivative: " + prediction.problem);
      }
      forward_.col(k) = *prediction.values;
      current_.jacobian.col(k) =
          (forward_.col(k) - current_.model).cwiseQuotient(current_.steps[k] * problem_.deviations);
      const double norm = current_.jacobian.col(k).norm(), longest = std::min(longest_step, 0.25 * width_[k]);
      steps_[k] =
          norm * longest > wanted_change ? std::max(wanted_change / norm, std::min(shortest_step, longest)) : longest;
    }
  }

  const LeastSquares& problem_;
  Vector width_;
  int most_evaluations_, n_evaluations_ = 0;
  double least_ = std::numeric_limits<double>::infinity();  ///< least χ² so far
  Vector steps_;                                            ///< of the next differences
  Minimum current_, trial_;
  Matrix forward_;  ///< the model at the neighbours of current_
};

}  // namespace

Minimum minimum_of(const LeastSquares& problem) {
  Residuals residuals(problem);
  Eigen::LevenbergMarquardt<Residuals> search(residuals);
  // The first step changes u by at most 2, over which a logistic function is nearly linear.
  search.useExternalScaling = true;
  search.diag = Vector::Ones(problem.start.size());
  search.parameters.factor = 2.0;
  search.parameters.ftol = 1e-4;
  search.parameters.xtol = 1e-6;
  Vector u = Vector::Zero(problem.start.size());
  const auto status = search.minimize(u);
  using namespace Eigen::LevenbergMarquardtSpace;
  const bool has_converged = status == RelativeReductionTooSmall || status == RelativeErrorTooSmall ||
                             status == RelativeErrorAndReductionTooSmall || status == CosinusTooSmall;
  return residuals.finish(u, has_converged);
}

}  // namespace vehd

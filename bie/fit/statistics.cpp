#include "bie/fit/statistics.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace vehd {
namespace {

/// Largest distance, up to 0.5, that p can move along both v and −v within the intervals.
double room_along(const LeastSquares& problem, const Vector& p, const Vector& v) {
  constexpr double longest = 0.5;
  double room = longest;
  for (Index k = 0; k < v.size(); ++k) {
    const double least = std::min(problem.upper[k] - p[k], p[k] - problem.lower[k]);
    if (v[k] != 0.0) room = std::min(room, least / std::abs(v[k]));
  }
  return room;
}

/// Half the change of the model from p − step to p + step, in deviations; 0 if it has no value.
Vector change_along(const LeastSquares& problem, Minimum& minimum, const Vector& step) {
  const std::vector<Prediction> ends = problem.model({minimum.point + step, minimum.point - step});
  minimum.n_evaluations += 2;
  if (!ends[0].values || !ends[1].values) return Vector::Zero(problem.data.size());
  return (*ends[0].values - *ends[1].values).cwiseQuotient(2.0 * problem.deviations);
}

/// Orthonormal basis of the directions orthogonal to these.
Matrix complement_of(const std::vector<Combination>& combinations, Index n) {
  if (combinations.empty()) return Matrix::Identity(n, n);
  Matrix directions(n, std::ssize(combinations));
  for (Index i = 0; i < directions.cols(); ++i) directions.col(i) = combinations[static_cast<std::size_t>(i)].direction;
  return Eigen::JacobiSVD<Matrix>(directions, Eigen::ComputeFullU).matrixU().rightCols(n - directions.cols());
}

}  // namespace

std::vector<Combination> undetermined_combinations(const LeastSquares& problem, Minimum& minimum) {
  const Eigen::JacobiSVD<Matrix> svd(minimum.jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const double error = problem.run_error * std::sqrt(0.5 * static_cast<double>(problem.data.size()));
  std::vector<Combination> undetermined;
  for (Index i = 0; i < svd.singularValues().size(); ++i) {
    const Vector v = svd.matrixV().col(i);
    const double jacobian_error = error * v.cwiseQuotient(minimum.steps).norm();
    if (svd.singularValues()[i] > jacobian_error) continue;
    const double room = room_along(problem, minimum.point, v);
    double change_error = error / room;
    if (!(change_error < jacobian_error)) {
      // An end of an interval is too near for a longer step.
      undetermined.push_back({v, 1.0 / jacobian_error});
      continue;
    }
    Vector change = change_along(problem, minimum, room * v) / room;
    if (change.norm() > change_error) {
      // The change may come from the curvature of a line of equal models: Richardson removes that.
      change = (8.0 * change_along(problem, minimum, 0.5 * room * v) / room - change) / 3.0;
      change_error *= std::hypot(8.0, 1.0) / 3.0;
    }
    minimum.jacobian += (change - minimum.jacobian * v) * v.transpose();
    if (!(change.norm() > change_error)) undetermined.push_back({v, 1.0 / change_error});
  }
  return undetermined;
}

std::vector<Index> Combination::parameters() const {
  constexpr double least_share = 0.05;
  std::vector<Index> parameters;
  for (Index k = 0; k < direction.size(); ++k) {
    if (std::abs(direction[k]) >= least_share) parameters.push_back(k);
  }
  std::ranges::stable_sort(parameters, std::greater{}, [&](Index k) { return std::abs(direction[k]); });
  return parameters;
}

Statistics statistics_of(const Matrix& jacobian, std::vector<Combination> undetermined,
                         const std::vector<Index>& at_end) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Index n = jacobian.cols();
  Statistics result;
  const Matrix determined = complement_of(undetermined, n);
  result.covariance = Matrix::Zero(n, n);
  if (determined.cols() > 0) {
    const Eigen::JacobiSVD<Matrix> svd(jacobian * determined, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Matrix root = determined * svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal();
    result.covariance = root * root.transpose();
  }
  result.errors = result.covariance.diagonal().cwiseSqrt();
  const Vector left = result.errors;
  for (const Combination& combination : undetermined) {
    for (Index k = 0; k < n; ++k) {
      const double moved = std::abs(combination.direction[k]) * combination.least_error;
      if (moved > left[k]) result.errors[k] = infinity;
    }
    for (const Index k : combination.parameters()) result.errors[k] = infinity;
  }
  for (const Index k : at_end) result.errors[k] = infinity;
  result.correlation = Matrix::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < n; ++k) {
      if (!std::isfinite(result.errors[i] + result.errors[k])) continue;
      result.correlation(i, k) = i == k ? 1.0 : result.covariance(i, k) / (result.errors[i] * result.errors[k]);
    }
  }
  result.undetermined = std::move(undetermined);
  return result;
}

}  // namespace vehd

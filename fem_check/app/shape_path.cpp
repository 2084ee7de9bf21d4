#include "fem_check/app/shape_path.hpp"

#include <algorithm>

#include "meshes/gauss_rule.hpp"

namespace vehd::fem_check {

ShapePath::ShapePath(const InTime& in_time)
    : times_(in_time.shape_times.begin(), in_time.shape_times.end()),
      positions_(in_time.positions),
      velocities_(in_time.velocities) {}

ShapePath::Weights ShapePath::weights(double time) const {
  constexpr std::size_t most_snapshots = 4;
  const std::size_t count = std::min(most_snapshots, times_.size());
  const auto after = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) - times_.begin());
  Weights result;
  result.first = std::min(after - std::min(after, count / 2), times_.size() - count);
  const auto first = times_.begin() + static_cast<std::ptrdiff_t>(result.first);
  const meshes::NodalPolynomials at_time({first, first + static_cast<std::ptrdiff_t>(count)}, {time});
  result.value = at_time.value.row(0);
  result.derivative = at_time.slope.row(0);
  return result;
}

Eigen::MatrixXd ShapePath::position(double time) const {
  const Weights w = weights(time);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(positions_.front().rows(), 3);
  for (Eigen::Index i = 0; i < w.value.size(); ++i) {
    result += w.value[i] * positions_[w.first + static_cast<std::size_t>(i)];
  }
  return result;
}

Eigen::MatrixXd ShapePath::sliding(double time) const {
  const Weights w = weights(time);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(positions_.front().rows(), 3);
  if (velocities_.empty()) return result;
  for (Eigen::Index i = 0; i < w.value.size(); ++i) {
    const std::size_t snapshot = w.first + static_cast<std::size_t>(i);
    result += w.derivative[i] * positions_[snapshot] - w.value[i] * velocities_[snapshot];
  }
  return result;
}

ShapePath ShapePath::coarser() const {
  ShapePath result;
  const std::size_t last = times_.size() - 1;
  const auto take = [&](std::size_t i) {
    result.times_.push_back(times_[i]);
    result.positions_.push_back(positions_[i]);
    if (last > 1) result.velocities_.push_back(velocities_[i]);
  };
  for (std::size_t i = 0; last > 1 && i < last; i += 2) take(i);
  take(last);
  return result;
}

}  // namespace vehd::fem_check

#pragma once

#include <functional>
#include <vector>

#include "fem_check/app/check_input.hpp"

namespace vehd::fem_check {

/// A moving shape: polynomials in time of degree at most 3 through the four nearest snapshots.
class ShapePath {
 public:
  explicit ShapePath(const InTime& in_time);

  /// Coefficients of x at a time, [n_coefficients x 3].
  [[nodiscard]] Eigen::MatrixXd position(double time) const;
  /// Coefficients of the relative velocity dx/dt − v of the points at fixed (θ, φ) and the membrane's material,
  /// [n_coefficients x 3].
  [[nodiscard]] Eigen::MatrixXd sliding(double time) const;
  /// Path through every other snapshot and the last one; with two snapshots, constant at the last one.
  [[nodiscard]] ShapePath coarser() const;

 private:
  struct Weights {
    std::size_t first = 0;
    Vector value, derivative;
  };
  ShapePath() = default;
  [[nodiscard]] Weights weights(double time) const;

  std::vector<double> times_;
  std::vector<Eigen::MatrixXd> positions_, velocities_;
};

}  // namespace vehd::fem_check

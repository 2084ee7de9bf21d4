#pragma once

#include <functional>
#include <vector>

#include "fem_check/app/check_input.hpp"

namespace vehd::fem_check {

/// A shape that moves: polynomials in time of degree 3 at most through the four snapshots that are nearest.
class ShapePath {
 public:
  explicit ShapePath(const InTime& in_time);

  /// Coefficients of x.
  [[nodiscard]] Eigen::MatrixXd position(double time) const;
  /// Of dx/dt at a direction (θ, φ), whose points slide along the membrane, less the velocity v of its material.
  [[nodiscard]] Eigen::MatrixXd sliding(double time) const;
  /// Through every other snapshot and the last; of two snapshots, standing still at the last.
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

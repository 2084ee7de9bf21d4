#pragma once

#include <functional>
#include <vector>

#include "bie/fit/prediction.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Data with standard deviations s_i and a model m(p) of them. Each of its n parameters p lies in an interval. p is
/// dimensionless: the logarithm of a positive quantity, or a quantity over the width of its interval.
struct LeastSquares {
  Vector data, deviations;     ///< d_i and s_i, [n_data]
  Vector lower, upper, start;  ///< of p, [n_parameters]
  double run_error = 0.1;      ///< error of a model value, in deviations
  /// m, [n_data], at several points p, [n_parameters] each.
  std::function<std::vector<Prediction>(const std::vector<Vector>& points)> model;
  /// Called after each evaluation; may be empty.
  std::function<void(int n_evaluations, double chi2)> report_progress{};
};

/// Minimum of χ² = Σ ((d_i − m_i)/s_i)².
struct Minimum {
  Vector point;      ///< p, [n_parameters]
  Vector model;      ///< m(p), [n_data]
  Vector residuals;  ///< (d_i − m_i)/s_i, [n_data]
  Matrix jacobian;   ///< ∂m_i/∂p_k / s_i, [n_data x n_parameters]; central differences, one-sided at bounds
  Vector steps;      ///< h_k of these differences, [n_parameters]
  /// Parameters at an end of their intervals: χ² would still fall if one of them alone moved beyond it.
  std::vector<Index> at_end{};
  bool converged = false;
  int n_evaluations = 0;  ///< of the model, each at one point

  [[nodiscard]] double chi2() const { return residuals.squaredNorm(); }
};

/// Minimises χ² by Levenberg–Marquardt (MINPACK's, of Eigen) in u with p = lower + (upper − lower)/(1 + e^{−u}), which
/// keeps p in its interval. Derivatives are differences with steps within 0.001 … 0.1 that change the model by about
/// three deviations, ‖h J‖ = 3: the error of a run is then a small part of the change. The search ends if a full step
/// would move p by less than a tenth of a standard error, or with `converged` false after 12 (n + 2) evaluations.
/// Needs at least as many data as parameters.
/// @throws InputError if the model has no value at the start or on either side of a point
/// Source: Moré 1978
Minimum minimum_of(const LeastSquares& problem);

}  // namespace vehd

#pragma once

#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// Nodes of one step of size 1 and how deferred correction works on them.
struct TimeRule {
  std::vector<double> nodes;  ///< c_1 < … < c_M = 1
  Matrix weights;             ///< q_mj of ∫_0^{c_m} over the points 0, c_1, …, c_M, [M x M+1]; zero for order 1
  /// d_m: a correction at node m is an implicit step of size d_m. From order 3 on they make I − D⁻¹Q nilpotent:
  /// infinitely stiff components converge in M sweeps, while the sizes c_m leave a part of them (0.67 for M = 3) at
  /// every sweep. For orders 1 and 2 the step is backward Euler.
  std::vector<double> implicit_sizes;
};

/// Order 1: the implicit Euler method. Order 2: the trapezoidal rule. Order 3: Radau IIA with two nodes. Orders 4 and
/// 5: Radau IIA with three, whose own order is 5. Radau methods remove infinitely stiff components within the step.
/// @param order  1 … highest_time_order
/// Accuracy: polynomials are integrated to 1e-14 up to the degree of the rule, and from order 3 on infinitely stiff
/// components converge in M sweeps to 1e-13 (tests/stepping/time/time_rules_test.cpp)
/// Source: Radau IIA methods, Hairer and Wanner 1996; sizes as in van der Houwen and Sommeijer 1991
TimeRule time_rule(int order);

/// 0, c_1, …, c_M.
std::vector<double> points_of(const TimeRule& rule);

/// q_j of ∫_0^c of the polynomial through values at these points, [number of points].
/// Accuracy: 1e-13 for polynomials of its degree (tests/stepping/time/time_rules_test.cpp)
Vector integration_weights(const std::vector<double>& points, double c);

/// Weights at x of values at these places for the polynomial through them and zero at x = 0, [number of places].
/// @param places  not zero
/// Accuracy: 1e-13 for polynomials of its degree (tests/stepping/time/time_rules_test.cpp)
Vector weights_from_zero(const Vector& places, double x);

/// Error of integration_weights for the integral of x^k/k!, k = power: the factor of f^(k) in the error of an integral.
double integration_error(const std::vector<double>& points, double c, int power);

/// Weights of values at these points for a derivative of the polynomial through them, at the mean of the points,
/// where the highest two are most accurate, [number of points].
/// Accuracy: 1e-12 for polynomials of its degree (tests/stepping/time/time_rules_test.cpp)
Vector derivative_weights(const std::vector<double>& points, int derivative);

/// Highest order that has a rule.
constexpr int highest_time_order = 5;

}  // namespace vehd

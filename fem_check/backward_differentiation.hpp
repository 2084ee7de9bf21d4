#pragma once

#include <functional>

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// V' = F(V, t) + E(V, t) with F stiff and treated implicitly, E explicitly.
struct TimeLaw {
  /// V of the implicit step: V = from + step F(V, time).
  std::function<Vector(const Vector& from, double step, double time)> implicit;
  /// E; absent: zero.
  std::function<Vector(const Vector& value, double time)> explicit_rate{};
};

/// Equal steps between two times.
struct TimeSteps {
  double begin;
  double end;
  int number;
};

/// Size of every implicit step, 2Δt/3.
double implicit_step(const TimeSteps& steps);

/// V at the end of the interval, by backward differentiation of order 2,
///
///   (3 V_{n+1} − 4 V_n + V_{n−1})/(2 Δt) = F(V_{n+1}, t_{n+1}) + 2 E(V_n, t_n) − E(V_{n−1}, t_{n−1}).
///
/// The first step is a Runge–Kutta method of order 2 with two stages, at t + 2Δt/3 and t + Δt/3, whose implicit steps
/// have the same size, so that one matrix suffices; E in this step is that of the start.
/// @param start  V at the beginning, [n] of any n, as all values and rates
/// @throws std::invalid_argument if the number of steps is not positive
/// Accuracy: order 2 in Δt, for any stiff F that decays (tests/fem_check/backward_differentiation_test.cpp)
/// Source: Hairer and Wanner, Solving Ordinary Differential Equations II, III.1 and IV.6
Vector advance(const TimeLaw& law, const Vector& start, const TimeSteps& steps);

}  // namespace vehd::fem_check

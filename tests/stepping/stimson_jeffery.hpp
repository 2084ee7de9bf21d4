#pragma once

#include <cmath>

namespace vehd::testing {

/// Drag of two equal spheres of radius a along their line of centres over 6πμaU, at a gap of h a.
/// Source: Stimson and Jeffery 1926
struct StimsonJeffery {
  double same;      ///< both move with velocity U
  double opposite;  ///< they move with U and −U
};

inline StimsonJeffery stimson_jeffery(double h) {
  const double alpha = std::acosh(1.0 + h / 2.0);
  const double sine = std::sinh(alpha);
  StimsonJeffery result{0.0, 0.0};
  constexpr int kTerms = 200;
  for (int n = 1; n <= kTerms && (n + 0.5) * alpha < 300.0; ++n) {
    const double s = n + 0.5, odd = 2.0 * n + 1.0;
    const double factor = 4.0 / 3.0 * sine * n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0));
    const double square = odd * odd * sine * sine;
    const double sinh2 = 4.0 * std::pow(std::sinh(s * alpha), 2), cosh2 = 4.0 * std::pow(std::cosh(s * alpha), 2);
    const double twice = 2.0 * std::sinh(2.0 * s * alpha), width = odd * std::sinh(2.0 * alpha);
    result.same += factor * (1.0 - (sinh2 - square) / (twice + width));
    result.opposite += factor * ((cosh2 + square) / (twice - width) - 1.0);
  }
  return result;
}

}  // namespace vehd::testing

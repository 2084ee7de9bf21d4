#pragma once

#include <cmath>

namespace vehd {

/// Velocities of the 2:1 prolate, semi-axes 1, 1, 2, at μ = 1 under the density (x·n) e, along its axis and across it.
/// That density has the total force 3 V e = 8π e and makes the Stokes single layer constant on the surface, so that it
/// is the density of the rigid particle; its speed follows from the resistance 6πμ·2·factor (Oberbeck; Kim & Karrila,
/// Microhydrodynamics, Table 3.4).
/// Accuracy: closed form to rounding; the assembled layer agrees to 1e-11 at p = 16 and to 5e-12 at p = 32
/// (tests/potentials/translating_prolate_test.cpp)
struct ProlateSpeeds {
  double along, across;
};
/// The speeds in closed form.
/// Source: Kim and Karrila 1991, Table 3.4
inline ProlateSpeeds translating_prolate_speeds() {
  const double e = std::sqrt(0.75);
  const double logarithm = std::log((1.0 + e) / (1.0 - e));
  const double along = 8.0 / 3.0 * e * e * e / (-2.0 * e + (1.0 + e * e) * logarithm);
  const double across = 16.0 / 3.0 * e * e * e / (2.0 * e + (3.0 * e * e - 1.0) * logarithm);
  return {2.0 / (3.0 * along), 2.0 / (3.0 * across)};
}

}  // namespace vehd

#pragma once

#include <cstdlib>

namespace vehd {

/// The map (x, y, z) → (±x, ±y, ±z), of space or of the unit sphere.
/// Eight of them, a group under composition.
/// Accuracy: exact
struct Reflection {
  int x = 1, y = 1, z = 1;

  /// Sign of the coordinate with this index.
  [[nodiscard]] int sign(int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  /// Sign of cos mφ (m ≥ 0) or sin |m|φ (m < 0) under the map of the azimuth.
  [[nodiscard]] int azimuthal_parity(int m) const {
    const int even = x > 0 || m % 2 == 0 ? 1 : -1;
    return m < 0 ? even * x * y : even;
  }
  /// Y_{n,m}(g s) = parity(n, m) Y_{n,m}(s).
  [[nodiscard]] int parity(int n, int m) const {
    return (z > 0 || (n + std::abs(m)) % 2 == 0 ? 1 : -1) * azimuthal_parity(m);
  }
  /// Index of the image of azimuth k of n_phi equispaced azimuths that start at φ = 0; n_phi must be even.
  [[nodiscard]] int azimuth(int k, int n_phi) const {
    const int rotated = x * y > 0 ? k : n_phi - k;
    return (x > 0 ? rotated : rotated + n_phi / 2) % n_phi;
  }
  bool operator==(const Reflection&) const = default;
};

}  // namespace vehd

#pragma once

#include <array>
#include <vector>

#include "bie/sphere/small_product.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Fourier sums over the azimuths ψ_k = (k + ½) 2π/n of a graded rule, and their adjoint, of many columns at once:
/// matrix products over a quarter of the circle, because terms at ψ, π − ψ, π + ψ and −ψ differ only in sign.
/// Accuracy: rounding (tests/potentials/azimuth_sums_test.cpp)
class AzimuthSums {
 public:
  AzimuthSums() = default;
  /// @param n_phi  azimuths, a multiple of 4
  /// @param order  highest m
  /// @throws ShapeError if n_phi is not a multiple of 4
  AzimuthSums(int n_phi, int order);

  /// Amplitudes of cos mψ for m = 0..order, then of sin mψ for m = 1..order.
  [[nodiscard]] Index n_modes() const { return 2 * order_ + 1; }
  /// Values at the azimuths, [n_phi x width].
  /// @param amplitudes  [n_modes x width], the width a multiple of kLanes
  [[nodiscard]] RowMatrix values(const RowMatrix& amplitudes) const;
  /// Σ_k of values times cos mψ_k or sin mψ_k.
  /// @param values  [n_phi x width], the width a multiple of kLanes
  /// @return  [n_modes x width]
  [[nodiscard]] RowMatrix adjoint(const RowMatrix& values) const;

 private:
  /// Modes of one parity under ψ → −ψ and one under ψ → π − ψ.
  struct Family {
    Index first = 0, count = 0;  ///< every second mode from the first one
    RowMatrix table;             ///< [quarter x modes]
  };

  int n_phi_ = 0;
  int order_ = 0;
  std::array<Family, 4> families_;  ///< cosines of even and odd m, sines of even and odd m
};

/// Quadrature over the sphere for an integrand that varies over the angle `scale` at the north pole and over 1/order
/// elsewhere: Gauss-Legendre in s on t = t(s), t the polar angle, with
///   s = asinh(t/scale) + order t/4,
/// times equispaced azimuth. Where |x − y|² ≈ h² + (c t)² the substitution t = scale sinh s puts the complex zeros of
/// the distance, t = ±i h/c, at Im s ≥ π/2 whenever scale ≤ h/c, so that the rate of convergence hardly depends on h;
/// the linear term keeps harmonics of degree p resolved away from the pole.
struct GradedRule {
  Vector theta;   ///< [n_theta]
  Vector weight;  ///< [n_theta], includes sin θ and 2π/n_phi
  int n_phi = 0;
  /// Per m tables [3 n_theta x (order + 1 − m)] of T(t) − T(0), dT/dt, m T/sin t, the first to full relative accuracy
  /// also at tiny t.
  std::vector<Matrix> synthesis;
  std::vector<RowMatrix> adjoint;  ///< synthesis by rows, padded with zeros to a multiple of kLanes
  AzimuthSums azimuths;

  [[nodiscard]] Index n_nodes() const { return theta.size() * n_phi; }
};

/// The rule with tables for harmonics of degree up to p.
/// @param order    p
/// @param n_theta, n_phi  multiples of 4
/// @param scale    smallest angle that is resolved, > 0; height over largest stretch of a foot point
/// @throws ShapeError if n_theta or n_phi is not a multiple of 4
/// Accuracy: spectral in n_theta and n_phi; a peak of width 1e-8 and more is integrated to 1e-11
/// (tests/potentials/foot_point_test.cpp)
/// Source: the substitution is that of Johnston and Elliott 2005
GradedRule make_graded_rule(int order, double scale, int n_theta, int n_phi);

}  // namespace vehd

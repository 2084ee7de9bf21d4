#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Gauss-Legendre nodes in cos θ (from the north pole down) times equispaced φ, Eq. (18).
/// A point has index j * n_phi + k (theta-major). Neither pole is a node.
/// Source: paper Eqs. (18), (22)
struct SphereGrid {
  int order = 0;  ///< p; n_theta = p + 1, n_phi = 2p + 2 unless said otherwise
  int n_theta = 0;
  int n_phi = 0;
  Vector theta;   ///< [n_theta]
  Vector phi;     ///< [n_phi]
  Vector weight;  ///< [n_theta], Gauss weight times 2π/n_phi: integrates over the unit sphere, Eq. (22)

  [[nodiscard]] Index n_points() const { return Index{n_theta} * n_phi; }
};

/// Grid of order + 1 latitudes and 2 order + 2 longitudes, which integrates products of two harmonics of degree `order`
/// exactly.
SphereGrid make_grid(int order);

/// The p + 1 latitudes of make_grid(order) with n_phi longitudes, for fields with few Fourier modes in φ.
SphereGrid make_grid(int order, int n_phi);

/// Number of longitudes of an upsampled grid: the smallest multiple of `step` not below `least` whose other factor has
/// no prime above 13, so that the Fourier transform of any library is fast.
int fast_longitudes(int least, int step = 2);

/// Gauss-Legendre rule on [-1, 1], nodes ascending.
struct GaussLegendre {
  Vector nodes;
  Vector weights;
};

/// The n nodes and weights, by Newton's method on P_n.
/// Accuracy: monomials are integrated to 1e-13 (tests/sphere/transform_test.cpp)
/// Source: Newton's method from the asymptotic roots, as Press et al. 1992
GaussLegendre gauss_legendre(int n);

}  // namespace vehd

#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

#include "bie/support/types.hpp"

/// Two equal spheres of radius 1 about (0, 0, ±d/2) in a uniform field of size 1 in a fluid of permittivity 1, by
/// multipoles about both centres: the linear systems are exact up to the truncation at the highest multipole.
namespace vehd::testing {

/// Polarisability of degree m for conductivities σ_i/σ_e = k, infinite k included.
inline double polarisability(int m, double k) { return std::isinf(k) ? -1.0 : -m * (k - 1.0) / (m * (k + 1.0) + 1.0); }
inline std::complex<double> polarisability(int m, std::complex<double> k) {
  return -static_cast<double>(m) * (k - 1.0) / (static_cast<double>(m) * (k + 1.0) + 1.0);
}

/// Product of two quantities, or its mean over a period for complex amplitudes.
inline double mean_product(double a, double b) { return a * b; }
inline double mean_product(std::complex<double> a, std::complex<double> b) { return 0.5 * (std::conj(a) * b).real(); }

/// Forces of attraction between the spheres.
struct SphereForces {
  double along;   ///< in a field along the line of centres
  double across;  ///< in a field across it: they repel each other
};

/// @param k  effective σ_i/σ_e for a multipole of degree m, k(m); if complex (at a frequency), the forces are means
template <class Ratio>
SphereForces sphere_forces_of(double gap, const Ratio& k, int n_multipoles = 60) {
  using Scalar = decltype(k(1));
  using Unknowns = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  const double d = 2.0 + gap;
  const auto coefficient = [](int m, int n, int shift) {
    // (m+n)!/((m+shift)!(n−shift)!)
    return std::exp(std::lgamma(m + n + 1.0) - std::lgamma(m + shift + 1.0) - std::lgamma(n - shift + 1.0));
  };
  SphereForces result{};
  for (const int shift : {0, 1}) {
    using System = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    System system = System::Identity(n_multipoles, n_multipoles);
    Unknowns rhs = Unknowns::Zero(n_multipoles);
    rhs[0] = -polarisability(1, k(1));
    for (int m = 1; m <= n_multipoles; ++m) {
      for (int n = 1; n <= n_multipoles; ++n) {
        const double sign = shift == 0 ? 1.0 : -1.0;
        system(m - 1, n - 1) += sign * polarisability(m, k(m)) * coefficient(m, n, shift) * std::pow(d, -(m + n + 1.0));
      }
    }
    const Unknowns a = system.partialPivLu().solve(rhs);
    // Field acting on each multipole, A = g L.
    const auto bracket = [&](int m) -> Scalar { return a[m - 1] / polarisability(m, k(m)); };
    double force = 0.0;
    for (int n = 1; n < n_multipoles; ++n) {
      if (shift == 0) force += -4.0 * std::numbers::pi * (n + 1.0) * mean_product(bracket(n + 1), a[n - 1]);
      if (shift == 1 && n >= 2)
        force += -4.0 * std::numbers::pi * 0.5 * n * (n - 1.0) * (n + 1.0) * mean_product(bracket(n), a[n - 2]);
    }
    (shift == 0 ? result.along : result.across) = force;
  }
  return result;
}

inline SphereForces sphere_forces(double gap, double k) {
  return sphere_forces_of(gap, [k](int) { return k; });
}

/// Forces on spheres with a membrane of conductance G_m (C_m/dt + G_m after one step from zero charge).
inline SphereForces charged_sphere_forces(double gap, double k, double conductance) {
  return sphere_forces_of(gap, [=](int m) { return k / (1.0 + m * k / conductance); });
}

}  // namespace vehd::testing

#pragma once

#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// Latitude factors T_nm of the real harmonics (factor √2 included for m > 0) with derivatives.
/// One matrix per m, [n_theta x (order + 1 − m)], column n − m.
struct LegendreTables {
  std::vector<Matrix> value;         ///< T
  std::vector<Matrix> d_theta;       ///< dT/dθ
  std::vector<Matrix> m_over_sin;    ///< m T / sin θ
  std::vector<Matrix> d2_theta;      ///< d²T/dθ²
  std::vector<Matrix> d_m_over_sin;  ///< d(m T / sin θ)/dθ
};

/// Tables at the given colatitudes, [n_theta], poles included. Derivatives follow from ladder relations in n and m,
/// without division by sin θ; relative accuracy near machine precision for order ≤ 256.
/// Source: normalised three-term recurrence in n from the sectoral functions, Holmes and Featherstone 2002
LegendreTables legendre_tables(int order, const Vector& theta);

/// Tables [n_theta x (order + 1 − m)] for m ≤ highest_m; some tables contain higher m as well.
LegendreTables legendre_tables(int order, const Vector& theta, int highest_m);

/// Coefficients of the three-term recurrence T_n = a (cos θ T_{n−1} − b T_{n−2}) at fixed m < n.
struct LegendreRecurrence {
  double a;
  double b;
};
/// Recurrence coefficients for 0 ≤ m < n.
LegendreRecurrence legendre_recurrence(int n, int m);

/// The factor of T_mm = legendre_sectoral_factor(m) sin θ T_{m−1,m−1}; T_00 = 1/√(4π).
/// Source: Holmes and Featherstone 2002
double legendre_sectoral_factor(int m);

}  // namespace vehd

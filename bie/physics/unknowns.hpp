#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// The unknowns y of a time step on one membrane, coefficients of one degree. They form a vector space: rates,
/// residuals and corrections are of this type too. A field without entries is zero.
struct Unknowns {
  Matrix position;  ///< x, [n_coefficients x 3]
  /// V_m, interior minus exterior; empty without an electric field. With displacement currents q_i/C_m, q_i the charge
  /// of the inner face, which stays continuous when the field jumps.
  Vector transmembrane_potential;
  /// (q_i + q_e)/C_m of both faces with displacement currents, else empty. If C_m varies over the membrane, both
  /// charges are divided by the C_m of its parameters.
  Vector free_charge{};
  Vector poration{};  ///< s of the membrane's PorationReaction; empty without one
};

/// y += weight x.
void axpy(double weight, const Unknowns& x, Unknowns& y);
/// a − b, member by member.
Unknowns operator-(const Unknowns& a, const Unknowns& b);

}  // namespace vehd

#pragma once

#include <vector>

#include "bie/comparison/frozen_state.hpp"
#include "bie/support/instruments.hpp"

namespace vehd {

/// What the boundary-integral side is compared in.
struct CheckContents {
  bool electric = false;  ///< some field or some V_m
  bool steady = false;    ///< a field that determines a steady V_m
  bool flow = false;      ///< a membrane that moves
};

/// @throws InputError if the scene has something that the finite-element side does not know
CheckContents check_contents(const FrozenState& frozen);

/// Boundary-integral solution at one order: coefficients of that order, empty where absent.
struct CheckFields {
  int order = 0;
  Vector charge;                ///< q, V_m prescribed
  Matrix force_electric;        ///< f_E, V_m prescribed
  Vector steady_potential;      ///< V_m under the membrane law, its mean over the area zero if nothing else fixes it
  Vector steady_charge;         ///< q that goes with it
  Matrix velocity;              ///< from the given force
  Matrix velocity_own_force;    ///< with this solution's own f_E in the force
  Vector sample_potential;      ///< φ at the sample points, V_m prescribed
  Matrix sample_velocity;       ///< v at the sample points, [n_points x 3], from the given force;
                                ///< empty where viscosities differ
  std::vector<bool> is_inside;  ///< side of each sample point
  double seconds = 0.0;
};

/// f on the fluid: f_b + f_λ − f_E of the frozen fields, and whatever else acts.
Matrix given_force(const FrozenState& frozen);

/// E_∞ at the frozen time.
Vector3 applied_field(const FrozenState& frozen);
/// ∂v_i/∂x_j of the background flow at the frozen time.
Matrix3 flow_gradient(const FrozenState& frozen);

/// Solves at an order not below that of the frozen state: shape, V_m and force are continued by zeros.
/// @param force    given_force, [n_coefficients x 3]
/// @param samples  [n_points x 3]
/// @throws ConvergenceError where a solve fails
/// Accuracy: spectral in the order; the comparison takes the difference of two orders for its error (docs/check.md)
/// Source: paper Eqs. (5), (11), (12), (14)
CheckFields check_fields(const FrozenState& frozen, const CheckContents& contents, const Matrix& force, int order,
                         const Matrix& samples);

}  // namespace vehd

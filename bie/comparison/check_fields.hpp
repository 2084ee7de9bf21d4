#pragma once

#include <vector>

#include "bie/comparison/check_problem.hpp"
#include "bie/support/instruments.hpp"

namespace vehd {

/// Boundary-integral solution of one vesicle at one order p: coefficients [(p+1)²], for vectors [(p+1)² x 3]; f_b and
/// f_c have the degree force_order. Absent fields are empty.
struct CheckFields {
  int order = 0;
  // Computed from x, V_m and the time only, as in a run.
  Vector charge;          ///< q
  Matrix force_electric;  ///< f_E
  /// Rate at material points: C_m dV_m/dt over the C_m of the membrane's parameters; with displacement currents
  /// D(q_i/C_m)/Dt.
  Vector potential_rate;
  /// Contribution to potential_rate of the part of the pores' G_m that truncation to the degree of the state removes;
  /// at that degree only.
  Vector rate_truncation;
  Vector potential_of_charges;   ///< V_m from the free charges; with displacement currents only
  Vector free_charge_rate;       ///< D(q_i + q_e)/Dt over C_m; with displacement currents only
  int force_order = 0;           ///< degree of f_b and f_c; at least twice that of the state if `order` is another
  Matrix force_bending;          ///< f_b
  Matrix force_curvature;        ///< f_c of a spontaneous curvature
  Matrix force_tension;          ///< f_λ
  Vector tension;                ///< λ
  bool tension_is_free = false;  ///< a uniform tension has no effect, as on a sphere
  double dilation = 0.0;         ///< ∇_γ·v of a membrane whose area depends on the tension
  Matrix velocity_of_shape;      ///< v due to all these forces
  /// v due to the part of these forces that truncation to the degree of the state removes; at that degree only.
  Matrix velocity_truncation;

  Vector steady_potential;      ///< V_m under the membrane law, with zero mean over the area if nothing else fixes it
  Vector steady_charge;         ///< q for steady_potential
  Matrix velocity;              ///< from the given force
  Matrix velocity_own_force;    ///< with this solution's own f_E in the force
  Vector sample_potential;      ///< φ at the sample points, V_m prescribed
  Matrix sample_velocity;       ///< v at the sample points, [n_points x 3], from the given force
  std::vector<bool> is_inside;  ///< side of each sample point
  double seconds = 0.0;
};

/// Forces per area that follow from the derivatives of the shape at each point, coefficients [n_coefficients x 3];
/// empty if the vesicle has none.
struct LocalForces {
  int order = 0;     ///< degree of both
  Matrix bending;    ///< f_b
  Matrix curvature;  ///< f_c of a spontaneous curvature
};

/// Local forces at any degree, also beyond highest_order, at the cost of a few transforms.
/// Accuracy: spectral; for a 1:1:5 ellipsoid of degree 56, f_b at the degrees 112 and 168 differs by less than 1e-5
/// (tests/comparison/local_forces_test.cpp)
LocalForces local_forces(const FrozenState& frozen, int order, std::size_t vesicle = 0);

/// Solves for all vesicles: at the degrees of the frozen state with the settings of its run, at others with shape, V_m
/// and force continued by zeros or truncated, and with solver tolerances no larger than their defaults. Sample points
/// at which no value can be found have NaN.
/// @param orders  degree of each vesicle
/// @throws ConvergenceError if a solve fails
/// Accuracy: spectral in the orders; the comparison takes the difference of two of them as its error (docs/check.md)
/// Source: paper Eqs. (5), (11), (12), (14) with the layers of all membranes
std::vector<CheckFields> check_fields(const CheckProblem& problem, const std::vector<int>& orders);

}  // namespace vehd

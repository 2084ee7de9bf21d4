#pragma once

#include <vector>

#include "bie/comparison/check_problem.hpp"
#include "bie/support/instruments.hpp"

namespace vehd {

/// Boundary-integral solution of one vesicle at one order p: coefficients [(p+1)²], of vectors [(p+1)² x 3]; f_b and
/// f_c have the degree force_order. Absent fields are empty.
struct CheckFields {
  int order = 0;
  // From x, V_m and the time alone, as a run computes them.
  Vector charge;          ///< q
  Matrix force_electric;  ///< f_E
  /// Of material points: C_m dV_m/dt over the C_m of the membrane's parameters, or with displacement currents
  /// D(q_i/C_m)/Dt.
  Vector potential_rate;
  /// Share in potential_rate of what G_m of pores loses when it is truncated to the degree of the state; that degree
  /// only.
  Vector rate_truncation;
  Vector potential_of_charges;  ///< V_m that follows from free charges; with displacement currents alone
  Vector free_charge_rate;      ///< D(q_i + q_e)/Dt over C_m; with displacement currents alone
  int force_order = 0;   ///< degree of f_b and f_c: of twice the degree of the state at least where `order` is another
  Matrix force_bending;  ///< f_b
  Matrix force_curvature;        ///< f_c of a spontaneous curvature
  Matrix force_tension;          ///< f_λ
  Vector tension;                ///< λ
  bool tension_is_free = false;  ///< a uniform tension does nothing: a sphere
  double dilation = 0.0;         ///< ∇_γ·v, of a membrane whose area follows the tension
  Matrix velocity_of_shape;      ///< v of all these forces
  /// v of what these forces lose when they are truncated to the degree of the state; that degree only.
  Matrix velocity_truncation;

  Vector steady_potential;      ///< V_m under the membrane law, its mean over the area zero if nothing else fixes it
  Vector steady_charge;         ///< q that goes with it
  Matrix velocity;              ///< from the given force
  Matrix velocity_own_force;    ///< with this solution's own f_E in the force
  Vector sample_potential;      ///< φ at the sample points, V_m prescribed
  Matrix sample_velocity;       ///< v at the sample points, [n_points x 3], from the given force
  std::vector<bool> is_inside;  ///< side of each sample point
  double seconds = 0.0;
};

/// Forces per area that follow from the derivatives of the shape at each point, coefficients [n_coefficients x 3];
/// empty where the vesicle has none.
struct LocalForces {
  int order = 0;     ///< degree of these
  Matrix bending;    ///< f_b
  Matrix curvature;  ///< f_c of a spontaneous curvature
};

/// Local forces at any degree, also beyond highest_order, at the cost of some transforms.
/// Accuracy: spectral; of a 1:1:5 ellipsoid of degree 56 the degrees 112 and 168 differ by less than 1e-5 in f_b
/// (tests/comparison/local_forces_test.cpp)
LocalForces local_forces(const FrozenState& frozen, int order, std::size_t vesicle = 0);

/// Solves for all vesicles: in the degrees of the frozen state with the settings of its run, in others with shape, V_m
/// and force continued by zeros or cut, and solvers no coarser than their defaults. Where no value can be found at a
/// sample point it is NaN.
/// @param orders  of each vesicle
/// @throws ConvergenceError where a solve fails
/// Accuracy: spectral in the orders; the comparison takes the difference of two of them for its error (docs/check.md)
/// Source: paper Eqs. (5), (11), (12), (14), the layers being those of all membranes
std::vector<CheckFields> check_fields(const CheckProblem& problem, const std::vector<int>& orders);

}  // namespace vehd

#pragma once

#include <vector>

#include "bie/comparison/check_samples.hpp"
#include "bie/comparison/frozen_state.hpp"
#include "bie/support/instruments.hpp"

namespace vehd {

/// Fields of the boundary-integral side that are compared.
struct CheckContents {
  bool electric = false;  ///< some field or some V_m
  bool steady = false;    ///< a field that determines a steady V_m, on a membrane that conducts alike everywhere
  bool flow = false;      ///< a membrane that moves
};

/// What can be compared at the frozen time.
/// @throws InputError if the finite-element side lacks an effect of the scene, or has it for one vesicle only
CheckContents check_contents(const FrozenState& frozen);

/// A frozen state as both methods are given it.
struct CheckProblem {
  FrozenState frozen;
  CheckContents contents;
  std::vector<Matrix> forces;  ///< total_force of the stored fields of each vesicle; empty ones without a flow
  CheckSamples samples;        ///< of one vesicle alone
};

/// Contents, forces and sample points of a frozen state.
/// @throws InputError as check_contents and total_force
CheckProblem check_problem(const FrozenState& frozen);

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
  Vector potential_of_charges;   ///< V_m that follows from free charges; with displacement currents alone
  Vector free_charge_rate;       ///< D(q_i + q_e)/Dt over C_m; with displacement currents alone
  int force_order = 0;           ///< degree of f_b and f_c: local_force_order() where `order` is not that of the state
  Matrix force_bending;          ///< f_b
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

/// f on the fluid per area, coefficients [n_coefficients x 3]: f_b + f_λ − f_E of the fields, and all other forces on
/// the shape.
/// @param fields   of the degree of the frozen state, stored or computed anew
/// @param vesicle  to which they belong
/// @throws InputError for a background flow that the finite-element side does not know
Matrix total_force(const FrozenState& frozen, const VesicleFields& fields, std::size_t vesicle = 0);

/// The parts of the model that are compared.
Model compared_model(const FrozenState& frozen, const CheckContents& contents);

/// Settings of the run at its degree. At another degree, where only an error is estimated, solvers are no coarser than
/// their defaults.
/// @param vesicle  whose degree is compared with `order`
NumericalSettings settings_at(const FrozenState& frozen, int order, std::size_t vesicle = 0);

/// E_∞ at the frozen time.
Vector3 applied_field(const FrozenState& frozen);
/// Factor of the pump current at the frozen time; 0 without a field.
double present_pump(const FrozenState& frozen);
/// ∂v_i/∂x_j of the background flow at the frozen time.
Matrix3 flow_gradient(const FrozenState& frozen);

/// Solves for all vesicles: in the degrees of the frozen state with the settings of its run, in others with shape, V_m
/// and force continued by zeros or cut, and solvers no coarser than their defaults. Where no value can be found at a
/// sample point it is NaN.
/// @param orders  of each vesicle
/// @throws ConvergenceError where a solve fails
/// Accuracy: spectral in the orders; the comparison takes the difference of two of them for its error (docs/check.md)
/// Source: paper Eqs. (5), (11), (12), (14), the layers being those of all membranes
std::vector<CheckFields> check_fields(const CheckProblem& problem, const std::vector<int>& orders);

}  // namespace vehd

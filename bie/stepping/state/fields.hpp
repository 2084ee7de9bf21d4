#pragma once

#include <array>
#include <limits>
#include <vector>

#include "bie/physics/membrane.hpp"
#include "bie/physics/unknowns.hpp"
#include "bie/stepping/state/rheology.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// The unknowns of one membrane and the other fields that move with its material points, spherical-harmonic
/// coefficients of one degree, index n² + n + m (docs/conventions.md). Fields of absent effects are empty.
struct SurfaceFields : Unknowns {
  Vector area_strain{};         ///< W/W_ref − 1
  Vector tension{};             ///< λ, also the initial guess of the next solve; empty unless inextensible
  MembraneMaterial material{};  ///< spatially varying properties
};

/// The physical fields of one membrane at one time, instantaneous (no step size enters): coefficients of its degree,
/// empty where the effect is absent. Forces are per area, acting as in f = f_b + f_λ − f_E.
struct VesicleFields {
  Matrix velocity;        ///< of the membrane, [n_coefficients x 3]
  Matrix force_bending;   ///< f_b
  Matrix force_tension;   ///< f_λ
  Matrix force_electric;  ///< f_E = [[n·Σ_el]]
  Matrix force_contact;   ///< of the contact potential
  Vector tension;         ///< λ
  Vector charge;          ///< q = [[∂φ/∂n]]
  Vector conductance;     ///< G_m + g(s) of a membrane that porates, else empty
  Vector potential;       ///< V_m if it follows from free charges, else empty
  // In an averaged ac field these replace V_m and q, and the electric force is its mean over a period.
  Matrix potential_amplitude;  ///< of V_m, complex: the columns are real and imaginary part, [n_coefficients x 2]
  Matrix charge_amplitude;     ///< of q, [n_coefficients x 2]
  // Free charge of the inner and of the outer face, per area; empty without displacement currents.
  Vector free_charge_in{};   ///< q_i = C_m V_m − ε_i E_i
  Vector free_charge_out{};  ///< q_e = ε_e E_e − C_m V_m
};

/// V_m of a membrane at one time, coefficients [n_coefficients]; empty without electricity and in an averaged field.
inline const Vector& transmembrane_potential(const SurfaceFields& membrane, const VesicleFields& fields) {
  return fields.potential.size() > 0 ? fields.potential : membrane.transmembrane_potential;
}

/// The fields of every membrane of a State.
struct Fields {
  std::vector<VesicleFields> vesicles;
};

/// Load of a membrane relative to its criterion of poration, see poration_load().
struct PorationLoad {
  double load = 0.0;                                       ///< reaches 1 when the criterion is met; 0 without one
  double rate = std::numeric_limits<double>::quiet_NaN();  ///< time derivative; NaN if unknown
  Vector3 place = Vector3::Zero();                         ///< of the largest load on the membrane
};

/// Values of history.csv for one membrane at one time. In an averaged field V_m and q are magnitudes of amplitudes.
struct VesicleDiagnostics {
  static constexpr double no_direction = std::numeric_limits<double>::quiet_NaN();
  double area = 0, volume = 0, reduced_volume = 0;
  double bending_energy_scaled = 0;  ///< ∫H² dA
  double tension_integral = 0;       ///< ∫λ dA, 0 without tension
  double Vm_north = 0, q_north = 0, Vm_max = 0;
  double extent_x = 0, extent_y = 0, extent_z = 0;
  double inclination_deg = 0;
  double area_drift = 0, volume_drift = 0;  ///< relative, signed
  double strain_max = 0;                    ///< max |W/W_ref − 1|
  double spectrum_tail = 0;                 ///< see docs/columns.md
  double wrinkle_degree = 0;                ///< see wrinkle_degree()
  double wrinkling_rate = 0;                ///< see wrinkling_rate(), at the mean tension, up to degree p
  double quadrature_error = 0;              ///< LayerCheck::error
  /// The layers are less accurate than NumericalSettings::quadrature_tolerance, and finer quadrature would help.
  bool quadrature_is_coarse = false;
  double separation = std::numeric_limits<double>::infinity();  ///< of its own parts, see separation()
  double centroid_x = 0, centroid_y = 0, centroid_z = 0;        ///< of the volume
  double centroid_velocity_x = 0, centroid_velocity_y = 0, centroid_velocity_z = 0;
  double tension_max = 0;            ///< largest λ, 0 without tension
  double elastic_energy_scaled = 0;  ///< ∫(H − c)² dA
  double aspect_ratio = 0;           ///< longest over shortest axis of the gyration tensor
  /// Of the gyration tensor along the field over across; NaN if the field has no direction.
  double aspect_ratio_field = no_direction;
  double shape_rate = 0;  ///< max |(v − v_c)·n| over √(A/4π), v_c the velocity of the centroid
  /// About the vorticity of the flow, 0 without one: turning().
  double tumbling_angle_deg = 0, tumbling_frequency = 0, treading_frequency = 0;
  /// s_2 … s_6 about the field, NaN if that has no direction: shape_modes().
  std::array<double, 5> shape_modes{no_direction, no_direction, no_direction, no_direction, no_direction};
  double Vm_pole_plus = 0,
         Vm_pole_minus = 0;  ///< where the line along the field leaves the membrane, 0 if that has no direction
  double Vm_phase_deg = 0;   ///< phase of V_m at the plus pole against an averaged field
  Rheology rheology{};       ///< of this vesicle only
  // With poration.
  double conductance_max = 0.0;                    ///< largest G_m
  double poration_max = 0.0, poration_mean = 0.0;  ///< of the porosity or of the density of pores
  PorationLoad load{};
  double poration_load = 0;  ///< PorationLoad::load
  // With a wall.
  double gap_wall = std::numeric_limits<double>::infinity();  ///< between the membrane and the wall
  double force_wall = 0.0;                                    ///< of the membrane on the fluid, towards the wall
  // With a pump or spatially varying properties.
  double elastic_energy = 0.0;                                     ///< ∫κ_B (H − c)² dA
  double net_force_x = 0.0, net_force_y = 0.0, net_force_z = 0.0;  ///< of the membrane on the fluid
  /// When and where the criterion of poration was first met; infinite and NaN until then.
  double poration_time = std::numeric_limits<double>::infinity();
  double poration_x = std::numeric_limits<double>::quiet_NaN(), poration_y = poration_x, poration_z = poration_x;
};

/// The diagnostics of every membrane of a State.
struct Diagnostics {
  std::vector<VesicleDiagnostics> vesicles;
};

}  // namespace vehd

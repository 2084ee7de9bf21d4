#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fem_check/flow.hpp"
#include "fem_check/potential.hpp"
#include "meshes/wall.hpp"

/// Input from the boundary-integral side, docs/check.md. Fields on γ are spherical-harmonic coefficients,
/// [n_coefficients x components]; an empty one is absent.
namespace vehd::fem_check {

/// Fluids, membrane, field and flow of the frozen state.
struct Physics {
  Vector3 field = Vector3::Zero();  ///< E_∞
  double conductivity_in = 1.0, conductivity_out = 1.0;
  double permittivity_in = 1.0, permittivity_out = 1.0;
  double capacitance = 1.0, conductance = 0.0;
  double viscosity_in = 1.0, viscosity_out = 1.0;
  double bending_modulus = 0.0;
  double spontaneous_curvature = 0.0;  ///< c of κ_B ∫ (H − c)² dA, H = −1 on the unit sphere
  Vector3 weight = Vector3::Zero();    ///< (ρ_i − ρ_e) g, force per volume: (weight·x) n on the membrane
  bool inextensible = true;
  Matrix3 flow_gradient = Matrix3::Zero();
};

/// Boundary-integral solution at one order.
struct BieFields {
  int order = 0;
  // Of x and V_m alone.
  Eigen::MatrixXd charge, force_electric, potential_rate;
  /// Share in potential_rate of what G_m of pores loses in truncation; in the order of the state only.
  Eigen::MatrixXd rate_truncation;
  Eigen::MatrixXd potential_of_charges, free_charge_rate;  ///< with displacement currents alone
  // In a degree of their own where `order` is not that of the state.
  Eigen::MatrixXd force_bending;    ///< f_b
  Eigen::MatrixXd force_curvature;  ///< f_c of a spontaneous curvature

  Eigen::MatrixXd force_tension, tension;
  bool tension_is_free = false;         ///< a uniform tension does nothing
  double dilation = 0.0;                ///< ∇_γ·v that the constraint asks for
  Eigen::MatrixXd velocity_of_shape;    ///< of all these forces
  Eigen::MatrixXd velocity_truncation;  ///< of what these forces lose in truncation; in the order of the state only

  Eigen::MatrixXd steady_potential, steady_charge;    ///< membrane law
  Eigen::MatrixXd velocity, velocity_own_force;       ///< force given; with the f_E of this order in it
  Eigen::MatrixXd sample_potential, sample_velocity;  ///< [n_samples x components]
};

/// Numbers of the snapshot that are judged.
struct StoredFields {
  Eigen::MatrixXd charge, force_electric, force_bending, force_tension, tension, velocity;
};

/// Points off the membrane at which φ and v are compared.
struct Samples {
  Vectors points;
  std::vector<bool> inside;
  std::vector<bool> near;  ///< within one grid spacing of γ
};

/// V_m of an earlier snapshot, and what acts on it from there to the time of the file.
struct InTime {
  double begin = 0.0;
  Eigen::MatrixXd potential;  ///< V_m there
  /// Evenly spaced between two discontinuities of the field, `intervals` of them; a discontinuity is there twice.
  Vector field_times;
  Vectors field;  ///< E_∞ at each of them
  int intervals = 0;
  /// Of snapshots on the way, or the last one alone if the shape stands still.
  Vector shape_times;
  std::vector<Eigen::MatrixXd> positions;
  std::vector<Eigen::MatrixXd> velocities;  ///< of the membrane's material; empty if the shape stands still
  Eigen::MatrixXd bie, bie_high;            ///< V_m at the time of the file, by boundary integrals with two step sizes
  Eigen::MatrixXd by_motion;                ///< what finer steps of the moving shape change; empty: it stands still

  [[nodiscard]] bool moves() const { return positions.size() > 1; }
};

/// A wall beside the vesicle, and what holds there.
struct InputWall {
  meshes::Wall place;
  WallFlow flow = WallFlow::no_slip;
  WallField field = WallField::insulating;
};

/// All that the file holds of one vesicle.
struct CheckInput {
  std::string source;
  std::string name;  ///< of the vesicle; empty where there is only one
  double time = 0.0;
  Eigen::MatrixXd position;
  Physics physics;
  std::optional<InputWall> wall;
  Eigen::MatrixXd potential;                        ///< V_m of the snapshot
  Eigen::MatrixXd conductance, pump_current;        ///< G_m where it varies, and J_p, outwards
  Eigen::MatrixXd free_charge_in, free_charge_out;  ///< q_i and q_e of its faces; with displacement currents alone
  Eigen::MatrixXd force;                            ///< f on the fluid
  StoredFields stored;
  double solver_tolerance = 0.0;  ///< at which the solvers of the run stop
  BieFields bie;                  ///< in the order of the state: what is compared
  BieFields bie_high;             ///< in another one: what estimates the error of the first
  Samples samples;
  std::optional<InTime> in_time;

  [[nodiscard]] bool electric() const { return potential.size() > 0; }
  [[nodiscard]] bool charged_faces() const { return free_charge_in.size() > 0; }
  [[nodiscard]] bool conducts_alike() const { return conductance.size() == 0 && pump_current.size() == 0; }
  [[nodiscard]] bool steady() const { return bie.steady_potential.size() > 0; }
  [[nodiscard]] bool flow() const { return force.size() > 0; }
};

/// Of each vesicle; source, time, what is outside and the far field are those of all.
/// @throws InputError if the file cannot be used or lacks a field that is compared
std::vector<CheckInput> read_check_inputs(const std::filesystem::path& path);

/// The scene or run that a file was made from; its own name where it does not say. @throws InputError
std::string source_of(const std::filesystem::path& path);

/// Shapes to be meshed.
struct InputShapes {
  std::vector<Eigen::MatrixXd> positions;  ///< coefficients of x, of each vesicle
  std::optional<meshes::Wall> wall;
};

/// Of any file of the boundary-integral side. @throws InputError
InputShapes read_shapes(const std::filesystem::path& path);

}  // namespace vehd::fem_check

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fem_check/flow.hpp"
#include "fem_check/potential.hpp"
#include "meshes/wall.hpp"

/// Input from the boundary-integral side, docs/check.md. Fields on γ are spherical-harmonic coefficients,
/// [n_coefficients x components]; an empty matrix is an absent field.
namespace vehd::fem_check {

/// Fluids, membrane, electric field and flow of the frozen state.
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
  // Determined by x and V_m only.
  Eigen::MatrixXd charge, force_electric, potential_rate;
  /// Error of potential_rate from truncating G_m of pores; only in the order of the state.
  Eigen::MatrixXd rate_truncation;
  Eigen::MatrixXd potential_of_charges, free_charge_rate;  ///< only with displacement currents
  // Their degree differs from `order` if `order` is not that of the state.
  Eigen::MatrixXd force_bending;    ///< f_b
  Eigen::MatrixXd force_curvature;  ///< f_c of a spontaneous curvature

  Eigen::MatrixXd force_tension, tension;
  bool tension_is_free = false;         ///< a uniform tension has no effect
  double dilation = 0.0;                ///< ∇_γ·v prescribed by the constraint
  Eigen::MatrixXd velocity_of_shape;    ///< under all these forces
  Eigen::MatrixXd velocity_truncation;  ///< due to the truncated part of these forces; only in the order of the state

  Eigen::MatrixXd steady_potential, steady_charge;    ///< under the membrane law
  Eigen::MatrixXd velocity, velocity_own_force;       ///< with the force given; with f_E of this order in it
  Eigen::MatrixXd sample_potential, sample_velocity;  ///< [n_samples x components]
};

/// Fields of the snapshot that are judged.
struct StoredFields {
  Eigen::MatrixXd charge, force_electric, force_bending, force_tension, tension, velocity;
};

/// Points off the membrane at which φ and v are compared.
struct Samples {
  Vectors points;
  std::vector<bool> inside;
  std::vector<bool> near;  ///< within one grid spacing of γ
};

/// V_m of an earlier snapshot, and the field and shape between it and the time of the file.
struct InTime {
  double begin = 0.0;
  std::string begin_text;     ///< with its unit
  Eigen::MatrixXd potential;  ///< V_m at `begin`
  /// Evenly spaced between two discontinuities of the field, in `intervals` intervals; a discontinuity occurs twice.
  Vector field_times;
  Vectors field;  ///< E_∞ at these times
  int intervals = 0;
  int fewest_steps = 0;  ///< between two discontinuities: at least four in a period of the field
  /// Times of the snapshots in this interval, or only that of the last one if the shape is constant.
  Vector shape_times;
  std::vector<Eigen::MatrixXd> positions;
  std::vector<Eigen::MatrixXd> velocities;  ///< of the membrane's material; empty if the shape is constant
  Eigen::MatrixXd bie, bie_high;            ///< V_m at the time of the file, by boundary integrals with two step sizes
  Eigen::MatrixXd by_motion;                ///< effect of smaller steps of a moving shape on V_m; else empty

  [[nodiscard]] bool moves() const { return positions.size() > 1; }
};

/// A wall beside the vesicle, and the conditions on it.
struct InputWall {
  meshes::Wall place;
  WallFlow flow = WallFlow::no_slip;
  WallField field = WallField::insulating;
};

/// Contents of the file for one vesicle.
struct CheckInput {
  std::string source;
  std::string name;  ///< of the vesicle; empty if there is only one
  double time = 0.0;
  std::string time_text;  ///< with its unit
  Eigen::MatrixXd position;
  Physics physics;
  std::optional<InputWall> wall;
  Eigen::MatrixXd potential;                        ///< V_m of the snapshot
  Eigen::MatrixXd conductance, pump_current;        ///< G_m if it varies, and J_p, positive outwards
  Eigen::MatrixXd free_charge_in, free_charge_out;  ///< q_i and q_e of the faces; only with displacement currents
  Eigen::MatrixXd force;                            ///< f, force of the membrane on the fluid
  StoredFields stored;
  double solver_tolerance = 0.0;  ///< at which the solvers of the run stopped
  BieFields bie;                  ///< in the order of the state: the fields that are compared
  BieFields bie_high;             ///< in another order: estimates the error of `bie`
  Samples samples;
  std::optional<InTime> in_time;

  [[nodiscard]] bool electric() const { return potential.size() > 0; }
  [[nodiscard]] bool charged_faces() const { return free_charge_in.size() > 0; }
  [[nodiscard]] bool conducts_alike() const { return conductance.size() == 0 && pump_current.size() == 0; }
  [[nodiscard]] bool steady() const { return bie.steady_potential.size() > 0; }
  [[nodiscard]] bool flow() const { return force.size() > 0; }
};

/// Reads the inputs of all vesicles; source, time, outer fluid and far field are equal in all of them.
/// @throws InputError if the file cannot be used or does not contain a field that is compared
std::vector<CheckInput> read_check_inputs(const std::filesystem::path& path);

/// The scene or run from which a file was made; the path of the file if this is not recorded. @throws InputError
std::string source_of(const std::filesystem::path& path);

/// Shapes to mesh.
struct InputShapes {
  std::vector<Eigen::MatrixXd> positions;  ///< coefficients of x for each vesicle
  std::optional<meshes::Wall> wall;
};

/// Reads the shapes of any file from the boundary-integral side. @throws InputError
InputShapes read_shapes(const std::filesystem::path& path);

}  // namespace vehd::fem_check

#pragma once

#include <filesystem>
#include <string>

#include "fem_check/types.hpp"

/// What the boundary-integral side hands over, docs/check.md. Fields on γ are spherical-harmonic coefficients,
/// [n_coefficients x components]; an empty one is absent.
namespace vehd::fem_check {

/// Fluids, membrane, field and flow of the frozen state.
struct Physics {
  Vector3 field = Vector3::Zero();  ///< E_∞
  double conductivity_in = 1.0, conductivity_out = 1.0;
  double permittivity_in = 1.0, permittivity_out = 1.0;
  double conductance = 0.0;
  double viscosity_in = 1.0, viscosity_out = 1.0;
  Matrix3 flow_gradient = Matrix3::Zero();
};

/// Boundary-integral solution at one order.
struct BieFields {
  int order = 0;
  Eigen::MatrixXd charge, force_electric;             ///< V_m given
  Eigen::MatrixXd steady_potential, steady_charge;    ///< membrane law
  Eigen::MatrixXd velocity, velocity_own_force;       ///< force given; with the f_E of this order in it
  Eigen::MatrixXd sample_potential, sample_velocity;  ///< [n_samples x components]
};

/// Points off the membrane at which φ and v are compared.
struct Samples {
  Vectors points;
  std::vector<bool> inside;
  std::vector<bool> near;  ///< within one grid spacing of γ
};

/// All that the file holds.
struct CheckInput {
  std::string source;
  double time = 0.0;
  Eigen::MatrixXd position;
  Physics physics;
  Eigen::MatrixXd potential;       ///< V_m of the snapshot
  Eigen::MatrixXd force;           ///< f on the fluid
  Eigen::MatrixXd force_electric;  ///< the f_E in it
  Eigen::MatrixXd velocity;        ///< of the snapshot
  BieFields bie, bie_high;
  Samples samples;

  [[nodiscard]] bool electric() const { return bie.charge.size() > 0; }
  [[nodiscard]] bool steady() const { return bie.steady_potential.size() > 0; }
  [[nodiscard]] bool flow() const { return bie.velocity.size() > 0; }
};

/// @throws InputError
CheckInput read_check_input(const std::filesystem::path& path);

/// Coefficients of x alone. @throws InputError
Eigen::MatrixXd read_position(const std::filesystem::path& path);

}  // namespace vehd::fem_check

#pragma once

#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// V_m at time 0; ignored without the electric model.
struct StartPotential {
  bool steady = false;  ///< that of the steady state
  Vector given{};       ///< coefficients of any degree, unless steady; empty: zero
};

/// One membrane at time 0.
struct StartMembrane {
  Matrix position;  ///< coefficients of x, [n_coefficients x 3]
  StartPotential potential{};
  MembraneMaterial material{};  ///< coefficients of any degree
};

/// State at time 0, every membrane in the degree of its position, with its own area, volume and area element as
/// references: strain zero.
/// @param discretisation  of the degrees of the positions
/// @throws ConvergenceError if a steady V_m is not found
/// @throws InputError if some of several vesicles start with a steady V_m and others do not
State initial_state(const Model& model, const Discretisation& discretisation,
                    const std::vector<StartMembrane>& membranes, double dt, Instruments& instruments);

}  // namespace vehd

#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "bie/comparison/frozen_state.hpp"
#include "bie/physics/wall.hpp"
#include "bie/potentials/layer_sums.hpp"

namespace vehd {

/// Points off the membrane at which φ and v are compared.
struct CheckSamples {
  Matrix points;      ///< [n_points x 3]
  Vector distance;    ///< from the membrane of the near ones; 0 for the others
  double near = 0.0;  ///< one grid spacing: nearer points count as near
};

/// Points within one grid spacing of the membrane on either side, and points further inside and outside; none beyond a
/// wall.
CheckSamples check_samples(const Matrix& position, const std::optional<Wall>& wall = {});

/// Values at points, [n_points x components], and the side of each.
using SampleValues = std::pair<Matrix, std::vector<Side>>;

/// Values at sample points, [n_points x components]: all in one call of `at`, or if that fails one by one, with NaN
/// where no value is found.
/// @param points     [n_points x 3]
/// @param is_inside  receives the side of each point
/// @param at         values at [n x 3] points; may throw ConvergenceError
Matrix where_possible(const Matrix& points, Index components, std::vector<bool>& is_inside,
                      const std::function<SampleValues(const Matrix&)>& at);

/// Fields of the boundary-integral side that are compared.
struct CheckContents {
  bool electric = false;  ///< some field or some V_m
  bool steady = false;    ///< a field that determines a steady V_m, on a membrane that conducts alike everywhere
  bool flow = false;      ///< a membrane that moves
};

/// A frozen state as both methods are given it.
struct CheckProblem {
  FrozenState frozen;
  CheckContents contents;
  std::vector<Matrix> forces;  ///< total_force of the stored fields of each vesicle; empty ones without a flow
  CheckSamples samples;        ///< of one vesicle alone
};

/// Contents, forces and sample points of a frozen state.
/// @throws InputError if the finite-element side lacks an effect of the scene, or has it for one vesicle only
CheckProblem check_problem(const FrozenState& frozen);

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

/// With the field and the pump of the frozen time; neither of them without [electric].
ElectricParameters electric_at(const FrozenState& frozen, std::size_t vesicle = 0);
/// ∂v_i/∂x_j of the background flow at the frozen time.
Matrix3 flow_gradient(const FrozenState& frozen);

}  // namespace vehd

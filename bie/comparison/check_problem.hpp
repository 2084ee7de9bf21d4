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
  Vector distance;    ///< distance of the near points from the membrane; 0 for the others
  double near = 0.0;  ///< one grid spacing: points up to this distance count as near
};

/// Points within one grid spacing of the membrane on either side, and points further inside and outside; none beyond a
/// wall.
/// @param position  coefficients of x, [n_coefficients x 3]
CheckSamples check_samples(const Matrix& position, const std::optional<Wall>& wall = {});

/// Values at points, [n_points x components], and the side of each.
using SampleValues = std::pair<Matrix, std::vector<Side>>;

/// Values at sample points, [n_points x components]: from one call of `at`, or if that fails point by point, with NaN
/// where no value is found.
/// @param points     [n_points x 3]
/// @param is_inside  receives the side of each point
/// @param at         values at [n x 3] points; may throw ConvergenceError
Matrix where_possible(const Matrix& points, Index components, std::vector<bool>& is_inside,
                      const std::function<SampleValues(const Matrix&)>& at);

/// Fields of the boundary-integral side that are compared.
struct CheckContents {
  bool electric = false;  ///< there is a field, a pump current, V_m or free charge
  bool steady = false;    ///< there is a field, and the membrane has no pores, varying conductance or pump
  bool flow = false;      ///< membranes move
};

/// A frozen state as given to both methods.
struct CheckProblem {
  FrozenState frozen;
  CheckContents contents;
  std::vector<Matrix> forces;  ///< total_force of the stored fields of each vesicle; empty matrices without a flow
  CheckSamples samples;        ///< with one vesicle only
};

/// Contents, forces and sample points of a frozen state.
/// @throws InputError if the finite-element side does not support an effect of the scene, or for one vesicle only
CheckProblem check_problem(const FrozenState& frozen);

/// Force f on the fluid per area, coefficients [n_coefficients x 3]: f_b + f_λ − f_E of the fields, and all other
/// forces on the shape.
/// @param fields   at the degree of the frozen state, stored or recomputed
/// @param vesicle  number of their vesicle
/// @throws InputError for a background flow that the finite-element side does not support
Matrix total_force(const FrozenState& frozen, const VesicleFields& fields, std::size_t vesicle = 0);

/// The parts of the model that are compared.
Model compared_model(const FrozenState& frozen, const CheckContents& contents);

/// Settings of the run at its degree. At another degree, where only an error is estimated, solver tolerances are no
/// larger than their defaults.
/// @param vesicle  whose degree is compared with `order`
NumericalSettings settings_at(const FrozenState& frozen, int order, std::size_t vesicle = 0);

/// Electric parameters with the field and the pump of the frozen time; both are zero without [electric].
ElectricParameters electric_at(const FrozenState& frozen, std::size_t vesicle = 0);
/// ∂v_i/∂x_j of the background flow at the frozen time.
Matrix3 flow_gradient(const FrozenState& frozen);

}  // namespace vehd

#pragma once

#include "bie/comparison/frozen_state.hpp"

namespace vehd {

/// Forces per area that follow from the derivatives of the shape at each point, coefficients [n_coefficients x 3];
/// empty where the vesicle has none.
struct LocalForces {
  int order = 0;     ///< degree of these
  Matrix bending;    ///< f_b
  Matrix curvature;  ///< f_c of a spontaneous curvature
};

/// Local forces on a membrane, which needs no layers.
/// @param position  coefficients of x in its degree, [n_coefficients x 3]
LocalForces local_forces(const FrozenState& frozen, const Membrane& membrane, const Matrix& position,
                         std::size_t vesicle = 0);

/// Local forces at any degree, also beyond highest_order, at the cost of some transforms.
/// Accuracy: spectral; of a 1:1:5 ellipsoid of degree 56 the degrees 112 and 168 differ by less than 1e-5 in f_b
/// (tests/comparison/local_forces_test.cpp)
LocalForces local_forces(const FrozenState& frozen, int order, std::size_t vesicle = 0);

/// Degree of the local forces beside a solution of degree `solved`: that of the state for the solution in it, otherwise
/// at least twice that of the state, since f_b has four derivatives of x and a few more degrees hardly change it.
/// @param order  of the state
int local_force_order(int order, int solved);

/// Local forces in local_force_order() beside a solution.
/// @param membrane  of the solution
/// @param position  coefficients of x in its degree, [n_coefficients x 3]
LocalForces local_forces_beside(const FrozenState& frozen, const Membrane& membrane, const Matrix& position,
                                std::size_t vesicle = 0);

}  // namespace vehd

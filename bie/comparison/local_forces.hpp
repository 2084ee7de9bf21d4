#pragma once

#include "bie/comparison/frozen_state.hpp"

namespace vehd {

/// Forces that the shape exerts at each point by its derivatives there, coefficients [n_coefficients x 3]; empty where
/// the vesicle has none.
struct LocalForces {
  int order = 0;     ///< degree of these
  Matrix bending;    ///< f_b
  Matrix curvature;  ///< f_c of a spontaneous curvature
};

/// On a membrane that needs no layers.
/// @param position  coefficients of x in its degree
LocalForces local_forces(const FrozenState& frozen, const Membrane& membrane, const Matrix& position,
                         std::size_t vesicle = 0);

/// At any degree, also beyond highest_order: they need no layers, and cost as little as some transforms.
/// Accuracy: spectral; of a 1:1:5 ellipsoid of degree 56 the degrees 112 and 168 differ by less than 1e-5 in f_b
/// (tests/comparison/local_forces_test.cpp)
LocalForces local_forces(const FrozenState& frozen, int order, std::size_t vesicle = 0);

/// Degree in which they are found where all else is found in `solved`: in that of the state as the run has them, beside
/// another one in twice that of the state at least. f_b has four derivatives of x, and what a few degrees more change
/// of it says little.
/// @param order  of the state
int local_force_order(int order, int solved);

/// In local_force_order() beside a solution.
/// @param membrane  that of the solution, `position` in its degree
LocalForces local_forces_beside(const FrozenState& frozen, const Membrane& membrane, const Matrix& position,
                                std::size_t vesicle = 0);

}  // namespace vehd

#pragma once

#include <array>

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// ∇_γ·v = Σ g^{ab} ∂_a x · ∂_b v of a velocity on γ, from the derivatives of both series.
/// @param position, velocity  coefficients, [n_coefficients x 3], of any two orders
/// @param directions          r̂ of the points, [3 x n]
/// Accuracy: rounding; 2 for v = x (tests/fem_check/app/surface_divergence_test.cpp)
Vector surface_divergence(const Eigen::MatrixXd& position, const Eigen::MatrixXd& velocity, const Vectors& directions);

/// Cartesian components of ∇_γ f = tᵃ ∂_a f for scalar fields on γ, [fields x points] each.
/// @param position    coefficients, [n_coefficients x 3]
/// @param fields      coefficients, [n_coefficients x fields]
/// @param directions  r̂ of the points, [3 x points]
std::array<Eigen::MatrixXd, 3> surface_gradients(const Eigen::MatrixXd& position, const Eigen::MatrixXd& fields,
                                                 const Vectors& directions);

}  // namespace vehd::fem_check

#pragma once

#include "fem_check/app/comparison.hpp"

/// Work of forces on smooth displacements of γ: fields w whose components are harmonics in (θ, φ) of degree at most 4.
/// The L2(γ) projection of the force onto these fields is compared, which has equal ∫ f·w dA with all of them. A force
/// is known much more accurately as a functional than as a field, whose short waves contain four derivatives of x.
namespace vehd::fem_check {

/// From a force field to its work on smooth displacements.
ComparedField work_on_smooth(ComparedField compared, const SurfacePoints& points);

/// From f_λ to its work on smooth displacements; the levels have λ, and
/// ∫ f_λ·w dA = −∫ λ ∇_γ·w dA.
/// @param compared  f_λ, with `values` the name of a tension of the levels
/// @param position  coefficients of x, [n_coefficients x 3]
ComparedField work_of_tension(ComparedField compared, const Eigen::MatrixXd& position, const SurfacePoints& points);

}  // namespace vehd::fem_check

#pragma once

#include "fem_check/app/comparison.hpp"

/// Work of forces on smooth displacements of γ: fields w whose components are harmonics in (θ, φ) of degree at most 4.
/// The L2(γ) projection of the force onto these fields is compared, which has equal ∫ f·w dA with all of them. A force
/// is known much more accurately as a functional than as a field, whose short waves contain four derivatives of x.
namespace vehd::fem_check {

/// Converts a question about a force field to one about its work on smooth displacements.
FieldQuestion work_on_smooth(FieldQuestion question, const SurfacePoints& points);

/// Converts a question about f_λ to one about its work on smooth displacements; the levels have λ, and
/// ∫ f_λ·w dA = −∫ λ ∇_γ·w dA.
/// @param question  about f_λ, with `values` the name of a tension of the levels
/// @param position  coefficients of x, [n_coefficients x 3]
FieldQuestion work_of_tension(FieldQuestion question, const Eigen::MatrixXd& position, const SurfacePoints& points);

}  // namespace vehd::fem_check

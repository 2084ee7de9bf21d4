#pragma once

#include "fem_check/app/comparison.hpp"

/// Work of forces on smooth displacements of γ: fields w whose components are harmonics in (θ, φ) of degree 4 at most.
/// It is compared as the L2(γ) projection of the force on these, which has the same ∫ f·w dA with all of them. As a
/// functional a force is known much better than as a field, whose small waves have four derivatives of x.
namespace vehd::fem_check {

/// Turns a question about a force as a field into one about its work on smooth displacements.
FieldQuestion work_on_smooth(FieldQuestion question, const SurfacePoints& points);

/// Turns a question about f_λ into one about its work on smooth displacements; the levels have λ, and
/// ∫ f_λ·w dA = −∫ λ ∇_γ·w dA.
/// @param question  about f_λ, `values` a tension of the levels
/// @param position  coefficients of x
FieldQuestion work_of_tension(FieldQuestion question, const Eigen::MatrixXd& position, const SurfacePoints& points);

}  // namespace vehd::fem_check

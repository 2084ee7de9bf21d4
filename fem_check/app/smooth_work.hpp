#pragma once

#include "fem_check/app/comparison.hpp"

/// Work of forces on smooth displacements of γ: fields w whose components are harmonics in (θ, φ) of degree 4 at most.
/// It is compared as the L2(γ) projection of the force on these, which has the same ∫ f·w dA with all of them. As a
/// functional a force is known much better than as a field, whose small waves have four derivatives of x.
namespace vehd::fem_check {

/// The same question about the work of a force.
FieldQuestion work_on_smooth(FieldQuestion question, const SurfacePoints& points);

/// The same question about the work of a tension force, which the levels have as λ: ∫ f_λ·w dA = −∫ λ ∇_γ·w dA.
/// @param question  about f_λ, `values` a tension of the levels
/// @param position  coefficients of x
FieldQuestion work_of_tension(FieldQuestion question, const Eigen::MatrixXd& position, const SurfacePoints& points);

}  // namespace vehd::fem_check

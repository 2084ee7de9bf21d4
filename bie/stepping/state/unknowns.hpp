#pragma once

#include "bie/stepping/state/surface_fields.hpp"

namespace vehd {

/// What a step solves for, one behind the other: x, and what there is of V_m, of free charge and of the state of
/// poration, [n_coefficients x 3 …].
Matrix unknowns(const SurfaceFields& fields);

/// Adds such columns, times a weight, to what is there.
/// @param columns  as many as unknowns() has of these fields
void add_unknowns(const Eigen::Ref<const Matrix>& columns, double weight, SurfaceFields& fields);

}  // namespace vehd

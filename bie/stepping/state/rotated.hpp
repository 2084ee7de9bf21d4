#pragma once

#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/model.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// Everything rotated by R, fields together with the parameter sphere: x ↦ R x(R⁻¹ s), V_m ↦ V_m(R⁻¹ s). R = axes goes
/// from the frame to the laboratory, R = axesᵀ the other way. A rotated state has nothing to recycle.
Model rotated(const Matrix3& rotation, Model model);
State rotated(const Matrix3& rotation, State state);
Fields rotated(const Matrix3& rotation, Fields fields);

}  // namespace vehd

#pragma once

#include "bie/physics/model.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// Everything rotated by R, fields together with the parameter sphere: x ↦ R x(R⁻¹ s), V_m ↦ V_m(R⁻¹ s). R = axes goes
/// from the frame to the laboratory, R = axesᵀ the other way. A rotated state has nothing to recycle and no past.
/// Accuracy: rounding; a rotation and its inverse give the shape back to 1e-13 (tests/stepping/state/frame_test.cpp)
Model rotated(const Matrix3& rotation, Model model);
/// A state likewise.
State rotated(const Matrix3& rotation, State state);
/// Fields likewise.
Fields rotated(const Matrix3& rotation, Fields fields);

}  // namespace vehd

#pragma once

#include <string>

#include "bie/physics/model.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/state/symmetry.hpp"

namespace vehd {

/// Everything rotated by R, fields together with the parameter sphere: x ↦ R x(R⁻¹ s), V_m ↦ V_m(R⁻¹ s). R = axes goes
/// from the frame to the laboratory, R = axesᵀ back. A rotated state has no recycled subspaces and no past.
/// Accuracy: rounding; a rotation and its inverse give the shape back to 1e-13 (tests/stepping/state/frame_test.cpp)
Model rotated(const Matrix3& rotation, Model model);
/// A rotated state.
State rotated(const Matrix3& rotation, State state);
/// Rotated fields.
Fields rotated(const Matrix3& rotation, Fields fields);

/// Cartesian coordinates in which a run computes: x_laboratory = origin + axes x_frame. The poles of the grid lie on
/// the third axis, and the origin is in the units of x.
struct Frame {
  Matrix3 axes = Matrix3::Identity();
  Vector3 origin = Vector3::Zero();

  [[nodiscard]] bool is_rotated() const { return axes != Matrix3::Identity(); }
  [[nodiscard]] bool is_laboratory() const { return !is_rotated() && origin.isZero(0.0); }
};

/// A right-handed frame whose third axis is the given direction of any length: a cyclic permutation of x, y, z if that
/// is one of them, which avoids rounding.
/// Accuracy: axes orthonormal to 1e-15 (tests/stepping/state/frame_test.cpp)
Frame frame_along(const Vector3& direction);

/// The frame in which the scene is axisymmetric about the third axis, or else has the most images with at least three
/// equal turns about it; the frame of the laboratory if there is none. Even if the symmetry is not used, a grid with
/// its poles on the axis suits such a scene best. If the effects are the same everywhere, the axis can be anywhere: the
/// origin is then the mean position of the membranes if that yields symmetries.
/// Accuracy: rounding; runs in the frame and in the laboratory agree to 1e-8 a step
/// (tests/stepping/state/frame_test.cpp)
Frame find_frame(const Model& model, const State& state);

/// symmetry_text with the laboratory names of the axes, and their intersection unless it is the origin.
std::string symmetry_text(const Symmetry& symmetry, const Frame& frame);

/// A model of the laboratory in the frame; unless the origin is zero, all effects except the wall must be the same
/// everywhere.
Model in_frame(const Frame& frame, Model of_laboratory);
/// A state of the laboratory in the frame.
State in_frame(const Frame& frame, State of_laboratory);
/// A state of the frame in the laboratory.
State in_laboratory(const Frame& frame, State of_frame);
/// Fields of the frame in the laboratory.
Fields in_laboratory(const Frame& frame, const Fields& of_frame);

}  // namespace vehd

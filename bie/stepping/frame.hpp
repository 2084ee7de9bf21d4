#pragma once

#include <string>

#include "bie/stepping/fields.hpp"
#include "bie/stepping/model.hpp"
#include "bie/stepping/state.hpp"

namespace vehd {

/// Cartesian axes in which a run computes: x_laboratory = axes x_frame. The poles of the grid lie on the third axis.
struct Frame {
  Matrix3 axes = Matrix3::Identity();

  [[nodiscard]] bool is_laboratory() const { return axes == Matrix3::Identity(); }
  bool operator==(const Frame& other) const { return axes == other.axes; }
};

/// A right-handed frame whose third axis is the given direction of any length: a cyclic permutation of x, y, z where
/// that is one of them, so that nothing is rounded there.
Frame frame_along(const Vector3& direction);

/// The frame in which the scene is axisymmetric about the third axis; that of the laboratory where there is none.
/// Whether or not the symmetry is used, a grid with its poles on the axis suits such a scene best.
Frame find_frame(const Model& model, const State& state);

/// "x", "y", "z" or the components of the third axis.
std::string axis_name(const Frame& frame);

/// Everything turned by the rotation R, fields together with the parameter sphere: x ↦ R x(R⁻¹ s), V_m ↦ V_m(R⁻¹ s).
/// R = axes goes from the frame to the laboratory, R = axesᵀ the other way.
Model turned(const Matrix3& rotation, Model model);
State turned(const Matrix3& rotation, State state);
Fields turned(const Matrix3& rotation, Fields fields);

}  // namespace vehd

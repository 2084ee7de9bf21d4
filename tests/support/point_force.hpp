#pragma once

#include "bie/geometry/surface.hpp"
#include "bie/kernels/stokes.hpp"

namespace vehd::testing {

/// Flow of a point force at viscosity 1 and its traction σ·n on a surface.
struct PointForce {
  Matrix velocity, traction;
};

inline PointForce point_force(const Surface& surface, const Vector3& source, const Vector3& force) {
  PointForce result{Matrix(surface.n_points(), 3), Matrix(surface.n_points(), 3)};
  for (Index i = 0; i < surface.n_points(); ++i) {
    const Vector3 r = surface.position.row(i).transpose() - source;
    const double d = r.norm();
    const Vector3 normal = surface.normal.row(i);
    result.velocity.row(i) = stokes_single_layer_prefactor(1.0) * (force / d + r.dot(force) / (d * d * d) * r);
    result.traction.row(i) = -3.0 / (4.0 * std::numbers::pi) * r.dot(force) * r.dot(normal) / (d * d * d * d * d) * r;
  }
  return result;
}

}  // namespace vehd::testing

#pragma once

#include "bie/physics/membrane.hpp"
#include "bie/stepping/state/fields.hpp"

/// An inextensible sphere is rigid. To first order its points can leave it at constant area elements, with the velocity
/// of Eq. (27); but any shape that they form has more area than the sphere of its volume, so a uniform tension, which
/// moves nothing on a sphere, grows until the membrane only translates and flows within itself.
namespace vehd {

/// The part of a membrane velocity that a sphere can follow, translation and divergence-free tangential flow:
/// coefficients, [n_coefficients x 3].
/// Accuracy: spectral; a sphere stays one to 1e-10 of its radius (tests/stepping/solve/rigid_sphere_test.cpp)
Matrix rigid_sphere_velocity(const Membrane& sphere, const Matrix& velocity);

/// Motion of the points of a sphere.
struct SphereMotion {
  Vector3 translation = Vector3::Zero();
  Matrix3 rotation = Matrix3::Identity();  ///< about the centre
  Matrix flow;                             ///< displacement within the sphere, before the rotation, [n_points x 3]
};

/// The motion by rigid_sphere_velocity during dt, with a finite rotation, which causes no strain at any dt.
/// @param velocity  coefficients, [n_coefficients x 3]
/// Accuracy: exact for constant velocities; Stokes's velocity of falling spheres and Faxén's drift in a tube to 1e-8 at
/// every time order (tests/stepping/solve/rigid_sphere_test.cpp)
SphereMotion motion_of_velocity(const Membrane& sphere, const Matrix& velocity, double dt);

/// The motion of points that end near x + displacement, with the rotation that is nearest to it. The flow is exact as
/// far as these ends lie on the translated sphere.
/// @param displacement  coefficients, [n_coefficients x 3]
SphereMotion motion_of_displacement(const Membrane& sphere, const Matrix& displacement);

/// The sphere after the motion, at its material points, which end on the translated sphere exactly. The strain that the
/// motion and earlier ones have left is undone: the points move along the gradient of a potential on the sphere. The
/// mean tension stays undetermined.
/// @param start  strain at the start of the step; V_m and λ at its end
SurfaceFields moved_sphere(const SurfaceFields& start, const Membrane& sphere, const SphereMotion& motion);

/// The sphere after the motion, at nodes that are only translated: each node takes the fields of the material point
/// that has arrived there. The surface is then the translated one of the start, however far its points turn and flow.
/// @param position  at the start of the step, coefficients [n_coefficients x 3]
/// @param material  after the motion, at the material points
/// @throws ConvergenceError if the flow within the sphere is too far for one step
SurfaceFields at_translated_nodes(const Matrix& position, const Membrane& sphere, const SphereMotion& motion,
                                  const SurfaceFields& material);

}  // namespace vehd

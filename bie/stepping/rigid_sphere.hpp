#pragma once

#include "bie/stepping/constrained_move.hpp"

/// An inextensible sphere is rigid. To first order its points may leave it at constant area elements, which is the
/// velocity of Eq. (27); but any shape that they form has more area than the sphere of its volume, so a uniform
/// tension, which acts on nothing, grows until the membrane only translates and flows within itself.
namespace vehd {

/// One step of the part of the membrane velocity that a sphere can follow: translation and divergence-free tangential
/// flow. Its rotation is a finite one, so that it strains nothing, and points end on the translated sphere exactly. The
/// mean tension stays undetermined and is reported as zero.
ConstrainedMove rigid_sphere_move(const State& state, const Evaluation::Parts& parts, const Vector& tension, double dt,
                                  const Landing& landing);

}  // namespace vehd

#pragma once

#include "meshes/frozen_shape.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// How the cube of a block mesh lies against a shape: its axes are the columns of V among the directions r̂ and the
/// columns of U in space. Both are rotations.
struct BlockAxes {
  Matrix3 in_directions;  // V
  Matrix3 in_space;       // U
};

/// Principal axes of the affine part M = U S Vᵀ, numbered and signed to lie close to the coordinate axes. Blocks that
/// follow them mesh a tilted disc like a flat one, and the outer sphere turns with the membrane however far x(θ, φ) has
/// been carried round. A shape without a marked axis keeps the coordinate axes as V: those of rounding errors would be
/// arbitrary.
BlockAxes principal_axes(const FrozenShape& shape);

/// The principal axes rotated, as far as the stretches S leave it open, to where the faces of the cube follow x(θ, φ)
/// best: by any rotation if no stretch is marked, about an axis if the other two are equal, else not at all.
///
/// Least truncation_error() over a grid of rotations that no symmetry of the cube maps onto each other, refined by a
/// compass search. The principal axes themselves stay unless a turn is a clear gain: on a sphere, and about the axis of
/// an axisymmetric shape, all turns are equal.
BlockAxes best_axes(const FrozenShape& shape);

/// With these axes V, and U = R V with the rotation R that is nearest to the affine part: the same directions for
/// several shapes.
BlockAxes axes_along(const FrozenShape& shape, const Matrix3& in_directions);

/// Error of polynomials of degree 5 for x(θ, φ) on the faces of a mesh with 3 cells per edge of the cube: root
/// mean square over these faces of the part of x of degree 6 in a face coordinate.
double truncation_error(const FrozenShape& shape, const Matrix3& in_directions);

/// Error for the unit normal, with any number of cells per edge: where a shape is strongly bent, its normal turns
/// within a small part of a face, however smooth x(θ, φ) is.
double normal_truncation_error(const FrozenShape& shape, const Matrix3& in_directions, int cells_per_edge);

/// Whether normal_truncation_error() is above 5e-4: with three cells per edge of the ellipsoids 1:1:5 and 1:1:0.2, not
/// of shapes that are bent no more than shape (33).
bool is_strongly_bent(const FrozenShape& shape, int cells_per_edge);

}  // namespace vehd::meshes

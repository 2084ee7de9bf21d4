#pragma once

#include "meshes/frozen_shape.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// Orientation of the cube of a block mesh relative to a shape: the axes of the cube are the columns of V in the space
/// of directions r̂ and the columns of U in physical space. Both are rotations.
struct BlockAxes {
  Matrix3 in_directions;  // V
  Matrix3 in_space;       // U
};

/// Principal axes of the affine part M = U S Vᵀ, numbered and signed to lie close to the coordinate axes. Blocks along
/// these axes mesh a tilted disc like a flat one, and the outer sphere turns with the membrane however far x(θ, φ) has
/// been rotated. If no stretch differs from the others, V is the identity: rounding errors would determine any other
/// axes.
BlockAxes principal_axes(const FrozenShape& shape);

/// The principal axes, rotated so that polynomials on the faces of the cube approximate x(θ, φ) best: by any rotation
/// if all stretches S are equal, about one axis if the other two are equal, otherwise not at all.
///
/// Minimises truncation_error() over a grid of rotations inequivalent under the symmetries of the cube, then by a
/// compass search. The principal axes are kept unless a rotation is clearly better: on a sphere, and about the axis of
/// an axisymmetric shape, all rotations are equivalent.
BlockAxes best_axes(const FrozenShape& shape);

/// Axes with this V, and U = R V with the rotation R nearest to the affine part: gives several shapes the same
/// directions.
BlockAxes axes_along(const FrozenShape& shape, const Matrix3& in_directions);

/// Error of approximating x(θ, φ) by polynomials of degree 5 on the faces of a mesh with 3 cells per edge of the cube:
/// root mean square over the faces of the part of x that has degree 6 in a face coordinate.
double truncation_error(const FrozenShape& shape, const Matrix3& in_directions);

/// The same error for the unit normal, with any number of cells per edge. If a shape is strongly bent, its normal turns
/// within a small part of a face, however smooth x(θ, φ) is.
double normal_truncation_error(const FrozenShape& shape, const Matrix3& in_directions, int cells_per_edge);

/// Whether normal_truncation_error() exceeds 5e-4. With three cells per edge it does for the ellipsoids 1:1:5 and
/// 1:1:0.2, but not for shapes that are bent no more than shape (33).
bool is_strongly_bent(const FrozenShape& shape, int cells_per_edge);

}  // namespace vehd::meshes

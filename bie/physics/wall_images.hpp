#pragma once

#include "bie/physics/wall.hpp"
#include "bie/potentials/near_rows.hpp"

/// The layers of a membrane's mirror image in a wall. What the image does at a point follows from what the membrane
/// does at the mirror image of that point: the same of an insulating wall, times −1 of an electrode, mirrored of a
/// flow; without slip the kernel is no_slip_flow. So no image has a parametrisation of its own.
namespace vehd {

/// Mirror images of points, [n x 3].
Matrix mirrored(const Wall& wall, const Matrix& points);

/// Does the image have this layer?
bool has_image(const Wall& wall, PairLayer layer);
/// The layer of the membrane which at mirrored points gives that of the image.
PairLayer layer_of_image(const Wall& wall, PairLayer layer);
/// Of all layers of a membrane those that its image needs at mirrored points.
PairSelection selection_of_image(const Wall& wall, PairSelection selection);
/// Values there as they are at the points: [n x 1], or of a flow [n x 3].
Matrix mirrored_back(const Wall& wall, PairLayer layer, const Matrix& values);

}  // namespace vehd

#pragma once

#include "bie/physics/wall.hpp"
#include "bie/potentials/near_rows.hpp"

/// Layers of a membrane's mirror image in a wall, from layers of the membrane at mirrored points: equal to them for an
/// insulating wall, times −1 for an electrode, mirrored for a flow; at a no-slip wall the kernel is no_slip_flow. So
/// images need no parametrisation of their own.
namespace vehd {

/// Mirror images of points, [n x 3].
Matrix mirrored(const Wall& wall, const Matrix& points);

/// Does the image have this layer?
bool has_image(const Wall& wall, PairLayer layer);
/// The layer of the membrane at mirrored points that gives this layer of the image.
PairLayer layer_of_image(const Wall& wall, PairLayer layer);
/// Layers of a membrane at mirrored points that give the selected layers of its image.
PairSelection selection_of_image(const Wall& wall, PairSelection selection);
/// Layer of the image at the points from values at mirrored points: [n x 1], or [n x 3] for a flow.
Matrix mirrored_back(const Wall& wall, PairLayer layer, const Matrix& values);

}  // namespace vehd

#include "bie/physics/wall_images.hpp"

namespace vehd {

Matrix mirrored(const Wall& wall, const Matrix& points) {
  const Vector heights = (points.rowwise() - wall.point.transpose()) * wall.normal;
  return points - 2.0 * heights * wall.normal.transpose();
}

bool has_image(const Wall& wall, PairLayer layer) {
  return is_stokes(layer) ? wall.flow != WallFlow::none : wall.field != WallField::none;
}

PairLayer layer_of_image(const Wall& wall, PairLayer layer) {
  if (wall.flow != WallFlow::no_slip || !is_stokes(layer)) return layer;
  return layer == PairLayer::stokes_single ? PairLayer::no_slip_single : PairLayer::no_slip_double;
}

PairSelection selection_of_image(const Wall& wall, PairSelection selection) {
  if (wall.field == WallField::none) {
    selection.laplace_single = selection.laplace_single_normal = false;
    selection.laplace_double = selection.laplace_double_normal = false;
  }
  if (wall.flow == WallFlow::no_slip) {
    selection.no_slip_single = selection.stokes_single;
    selection.no_slip_double = selection.stokes_double;
  }
  if (wall.flow != WallFlow::stress_free) selection.stokes_single = selection.stokes_double = false;
  return selection;
}

Matrix mirrored_back(const Wall& wall, PairLayer layer, const Matrix& values) {
  if (is_stokes(layer)) return values * wall.mirror();
  return wall.field == WallField::electrode ? Matrix(-values) : values;
}

}  // namespace vehd

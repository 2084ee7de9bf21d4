#include "bie/physics/wall.hpp"

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/maximum.hpp"

namespace vehd {

WallGap nearest_to_wall(const Wall& wall, const SphereTransform& fine, const Matrix& position) {
  const Vector along_normal = position * wall.normal;
  const Top lowest = top_of(fine.grid(), fine.synthesize_hessian(along_normal), 0, along_normal, -1.0);
  const Vector3 place =
      evaluate_harmonics(position, direction(lowest.point).transpose(), fine.order()).row(0).transpose();
  return {wall.height(place), place};
}

WallGap nearest_to_wall(const Wall& wall, const Matrix& position) {
  const int order = order_of(position.rows());
  return nearest_to_wall(wall, SphereTransform(order, make_grid(2 * order)), position);
}

}  // namespace vehd

#include "bie/scene/shape_nodes.hpp"

#include <algorithm>

namespace vehd {

SphereTransform shape_transform(int order) {
  constexpr int coarsest = 64;
  return {order, make_grid(std::max(3 * order, coarsest))};
}

}  // namespace vehd

#include "meshes/wall.hpp"

#include "meshes/surface_samples.hpp"

namespace vehd::meshes {

double gap_to(const Wall& wall, const FrozenShape& shape) {
  return (wall.normal.transpose() * (surface_samples(shape).colwise() - wall.point)).minCoeff();
}

}  // namespace vehd::meshes

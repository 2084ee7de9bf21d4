#include "bie/geometry/roundness.hpp"

namespace vehd {

double distance_variation(const Surface& surface) {
  const Vector distance = (surface.position.rowwise() - centroid(surface).transpose()).rowwise().norm();
  return distance.maxCoeff() - distance.minCoeff();
}

}  // namespace vehd

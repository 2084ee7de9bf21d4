#include "meshes/separating_plane.hpp"

#include <algorithm>

#include "meshes/surface_samples.hpp"

namespace vehd::meshes {

SeparatingPlane separating_plane(const FrozenShape& first, const FrozenShape& second) {
  const Eigen::Matrix3Xd a = surface_samples(first), b = surface_samples(second);
  constexpr int kMostSteps = 5000;
  constexpr double kPrecision = 0.05;
  const double nothing = 1e-9 * (first.radius() + second.radius());
  SeparatingPlane best;
  Point shortest = second.centroid() - first.centroid();  // a vector between the hulls
  for (int step = 0; step < kMostSteps && shortest.norm() > nothing; ++step) {
    const double length = shortest.norm();
    const Point normal = shortest / length;
    Eigen::Index upper = 0, lower = 0;
    const double end_of_first = (normal.transpose() * a).maxCoeff(&upper);
    const double begin_of_second = (normal.transpose() * b).minCoeff(&lower);
    const double width = begin_of_second - end_of_first;
    if (width > best.width) best = {normal, 0.5 * (end_of_first + begin_of_second), width};
    if (width >= (1.0 - kPrecision) * length) break;
    // Point nearest to the origin on the segment from here to the difference of the extreme points.
    const Point way = b.col(lower) - a.col(upper) - shortest;
    shortest += std::clamp(-shortest.dot(way) / way.squaredNorm(), 0.0, 1.0) * way;
  }
  if (best.width > nothing) return best;
  throw MeshError("no plane separates the two membranes, but the blocks of the mesh need one");
}

}  // namespace vehd::meshes

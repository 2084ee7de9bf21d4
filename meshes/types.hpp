#pragma once

#include <Eigen/Core>
#include <stdexcept>

namespace vehd::meshes {

/// A point or a vector of space.
using Point = Eigen::Vector3d;
/// A Jacobian or a frame.
using Matrix3 = Eigen::Matrix3d;

/// A mesh that cannot be used: an element inverted or too flat, a shape that the outer sphere does not hold, or a
/// mesher that gave up. The message names the place.
class MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vehd::meshes

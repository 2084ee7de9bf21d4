#pragma once

#include <Eigen/Core>
#include <stdexcept>

namespace vehd::meshes {

/// A point or a vector in space.
using Point = Eigen::Vector3d;
/// A Jacobian or a frame.
using Matrix3 = Eigen::Matrix3d;

/// An unusable mesh: an inverted or too flat element, a shape that does not fit into the outer sphere, or a failure of
/// the mesher. The message names the position.
class MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vehd::meshes

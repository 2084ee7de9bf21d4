#pragma once

#include <vector>

#include "fem_check/stokes_system.hpp"

namespace vehd::fem_check {

/// Velocities along a stress-free wall: their component along the normal vanishes on it.
class SlipWall {
 public:
  /// @param tangential  preconditions the components along the wall, which are free there; must outlive this object
  /// @param fixed       constraints of the component along the normal
  SlipWall(const Space& space, const Multigrid& tangential, const Fixed& fixed, const ScalarForm& form);

  /// Removes the component along the normal on the wall.
  void project(Blocks& velocity) const;
  /// Applies multigrid to each component in the frame of the wall.
  void precondition(Blocks& to, const Blocks& from) const;

 private:
  const Multigrid& tangential_;
  Multigrid normal_component_;
  Matrix3 frame_;                // columns; the normal is the last one
  std::vector<unsigned> nodes_;  // on the wall; local numbers
};

}  // namespace vehd::fem_check

#pragma once

namespace vehd::meshes {

/// One of the 13 blocks of a block mesh.
struct Block {
  enum class Layer { core, blend, shell };
  Layer layer;
  int axis;     ///< coordinate axis that cuts the block's face of the cube; unused in the core
  double sign;  ///< +1 or −1: the side of the cube
};

}  // namespace vehd::meshes

#pragma once

#include <filesystem>
#include <string>

#include "bie/comparison/fem_program.hpp"
#include "bie/comparison/frozen_state.hpp"

namespace vehd {

/// Which mesh is made, and where it goes.
struct MeshTask {
  const FrozenShape& shape;
  std::filesystem::path output;  ///< MSH 4.1; untouched where the mesh cannot be made
  std::string family = "hex";    ///< "hex": curved blocks; "tet": unstructured tetrahedra
  int refine = 0;                ///< how often the element size is divided by 1.5
};

/// Has the finite-element side mesh the inside and the outside of one shape, or of two.
/// @return its figures of quality
/// @throws OutputError
FemProgram::Result write_volume_mesh(const FemProgram& fem, const MeshTask& task);

}  // namespace vehd

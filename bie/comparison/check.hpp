#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "bie/comparison/check_fields.hpp"
#include "bie/comparison/fem_program.hpp"
#include "bie/comparison/frozen_state.hpp"
#include "bie/comparison/time_span.hpp"

namespace vehd {

/// Options of a check.
struct CheckTask {
  FrozenState frozen;
  std::filesystem::path directory;   ///< for the files of both sides; created if missing
  std::optional<TimeSpan> span{};    ///< on which V_m is advanced to the frozen time
  bool quick = false;                ///< coarse elements, and boundary integrals that are not finer than they need
  std::optional<double> required{};  ///< share of a field that errors may reach; absent: the finite elements' own
  /// Processes of the finite elements; absent: as many as other programs leave processors meanwhile, eight at most.
  std::optional<int> n_ranks{};
  /// Told when the boundary integrals are solved in the degree of the state, and then in that of estimate_order();
  /// may be empty.
  std::function<void(const CheckFields&)> tell{};
};

/// Degree of a second solution, whose difference from that of `order` is the estimated error of the latter: twice as
/// high, but beyond highest_order no more than 16 higher.
/// @param quick  one that costs little
int estimate_order(int order, bool quick);

/// Solves the frozen state by boundary integrals, lets the finite elements solve and compare it, and waits for them.
/// @throws InputError if the finite elements lack an effect of the state, OutputError if a file cannot be written
FemProgram::Result compare_methods(const FemProgram& fem, const CheckTask& task);

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

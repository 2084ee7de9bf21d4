#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "bie/comparison/check_fields.hpp"
#include "bie/comparison/fem_program.hpp"
#include "bie/comparison/frozen_state.hpp"
#include "bie/comparison/time_span.hpp"

namespace vehd {

/// Options of a check.
struct CheckTask {
  FrozenState frozen;
  std::filesystem::path directory;   ///< for the files of both sides; created if missing
  std::optional<TimeSpan> span{};    ///< over which V_m is advanced to the frozen time
  bool quick = false;                ///< coarse elements, and a lower degree of the second boundary-integral solution
  std::optional<double> required{};  ///< limit of errors over the field; absent: that of the finite elements
  /// Processes of the finite elements; absent: as many as other programs leave processors free, at most eight.
  std::optional<int> n_ranks{};
  /// Called when the boundary integrals are solved at the degree of the state, and then at that of estimate_order();
  /// may be empty.
  std::function<void(const CheckFields&)> on_solved{};
};

/// Degree of a second solution, whose difference from that of `order` is the estimated error of the latter: doubled up
/// to degree 24, then 48 or 16 higher than `order`, whichever is higher.
/// @param quick  one and a half times `order`, at most 28, but at least two higher
int estimate_order(int order, bool quick);

/// Processors that other programs leave free, while this one runs a single thread, which the load includes.
/// @param load        text of /proc/loadavg; anything else counts as an idle machine
/// @param processors  of the machine
/// @param most        number that this process may use
/// @return            1 to most
int free_processors(const std::string& load, int processors, int most);

/// Solves the frozen state by boundary integrals, lets the finite-element program solve and compare it, and waits.
/// @throws InputError if the finite elements lack an effect of the state, OutputError if a file cannot be written
FemProgram::Result compare_methods(const FemProgram& fem, const CheckTask& task);

/// Which mesh is made, and its file.
struct MeshTask {
  const FrozenShape& shape;
  std::filesystem::path output;  ///< MSH 4.1; unchanged if the mesh cannot be made
  std::string family = "hex";    ///< "hex": curved blocks; "tet": unstructured tetrahedra
  int refine = 0;                ///< how often the element size is divided by 1.5
};

/// Meshes the inside and the outside of one or two shapes by the finite-element program.
/// @return  measures of the quality of the mesh
/// @throws OutputError
FemProgram::Result write_volume_mesh(const FemProgram& fem, const MeshTask& task);

}  // namespace vehd

#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "bie/files/hdf5_writer.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

/// Layout of run.h5. Stable: the finite-element side and users' scripts read it.
namespace vehd {

/// What 1 of a unit of run.h5, as "force/area", is in SI base units; NaN where nobody says.
using SiScale = std::function<double(std::string_view unit)>;

/// Everything of run.h5 that does not depend on time.
struct RunHeader {
  std::string scene;  ///< effective scene
  int threads = 1;
  SiScale si_scale;
};

/// Six digits, so that the order of names is the order of time.
std::string snapshot_name(std::int64_t number);

/// Writes the header into an empty file.
/// @param transform  between degree p and the grid of the file
void write_run_header(Hdf5Writer& file, const SphereTransform& transform, const RunHeader& header);

/// Writes /snapshots/NAME: grid fields, coefficients/ and surface/.
/// @param state, fields  of the degree of the transform
/// @param si_scale  every dataset says in `scale` what it says
/// @return its checksum
/// @throws OutputError
std::int64_t write_snapshot(Hdf5Writer& file, const std::string& name, const SphereTransform& transform,
                            const State& state, const Fields& fields, const SiScale& si_scale);

}  // namespace vehd

#pragma once

#include <string>
#include <vector>

#include "bie/files/hdf5_writer.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/files/si_unit.hpp"
#include "bie/sphere/grid.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

/// Layout of run.h5. Stable: the finite-element side and users' scripts read it.
namespace vehd {

/// Everything of run.h5 that does not depend on time.
struct RunHeader {
  std::string scene;  ///< effective scene
  int threads = 1;
  SiUnits si_units;
};

/// Six digits, so that the order of names is the order of time.
std::string snapshot_name(std::int64_t number);

/// Writes the header into an empty file; whoever adds nothing more to it seals it.
/// @param transform  between degree p and the grid of the file
void write_run_header(Hdf5Writer& file, const SphereTransform& transform, const RunHeader& header);

/// Name of a vesicle below a snapshot of several: at least two digits.
std::string vesicle_group(std::size_t vesicle);

/// Writes /snapshots/NAME, sealed: grid fields, coefficients/ and surface/; of several vesicles the same of each in
/// /snapshots/NAME/vesicles/NN, with its grid.
/// @param state, fields  each vesicle in the degree that it was solved in, which its attribute "degree" keeps: the file
///                       has it continued by zeros to that of the transform
/// @param si_units  every dataset says in `unit` and `scale` what it says
/// @return the checksum of its seal
/// @throws OutputError
std::int64_t write_snapshot(Hdf5Writer& file, const std::string& name, const SphereTransform& transform,
                            const State& state, const Fields& fields, const SiUnits& si_units);

/// Content of run.xdmf: the closed surfaces of every snapshot of a run.h5 beside it, and the wall.
struct XdmfSeries {
  std::string heavy_data = "run.h5";
  Index n_points = 0;  ///< grid points and both poles
  Index n_triangles = 0;
  std::vector<std::string> scalars;  ///< names of the datasets under surface/
  std::vector<std::string> vectors;
  std::vector<double> times;   ///< of snapshots 000000, 000001, ...
  std::size_t n_vesicles = 1;  ///< of each snapshot
  std::vector<Matrix> walls;   ///< of each snapshot the corners of a square of the wall, [4 x 3]; empty without one
};

/// The XML text that ParaView opens.
std::string xdmf_text(const XdmfSeries& series);

}  // namespace vehd

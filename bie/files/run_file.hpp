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

/// The time-independent content of run.h5.
struct RunHeader {
  std::string scene;  ///< effective scene
  int threads = 1;
  SiUnits si_units;
};

/// Name of a snapshot: six digits, so that the order of names is the order of time.
std::string snapshot_name(std::int64_t number);

/// Writes the header into an empty file; the caller seals it when nothing more is added.
/// @param transform  between degree p and the grid of the file
void write_run_header(Hdf5Writer& file, const SphereTransform& transform, const RunHeader& header);

/// Name of a vesicle in a snapshot of several: at least two digits.
std::string vesicle_group(std::size_t vesicle);

/// Writes /snapshots/NAME with its seal: grid fields, coefficients/ and surface/; with several vesicles, these and the
/// grid of each in /snapshots/NAME/vesicles/NN.
/// @param state, fields  each vesicle at the degree at which it was solved, which its attribute "degree" stores; in the
///                       file it is continued by zeros to the degree of the transform
/// @param si_units  units that every dataset states in its attributes `unit` and `scale`
/// @return the checksum of its seal
/// @throws OutputError
std::int64_t write_snapshot(Hdf5Writer& file, const std::string& name, const SphereTransform& transform,
                            const State& state, const Fields& fields, const SiUnits& si_units);

/// Content of run.xdmf: the closed surfaces of every snapshot in the run.h5 beside it, and the wall.
struct XdmfSeries {
  std::string heavy_data = "run.h5";
  Index n_points = 0;  ///< grid points and both poles
  Index n_triangles = 0;
  std::vector<std::string> scalars;  ///< names of the datasets under surface/
  std::vector<std::string> vectors;
  std::vector<double> times;   ///< times of snapshots 000000, 000001, ...
  std::size_t n_vesicles = 1;  ///< number in each snapshot
  std::vector<Matrix> walls;   ///< for each snapshot, corners of a square of the wall, [4 x 3]; empty without a wall
};

/// The XML text that ParaView opens.
std::string xdmf_text(const XdmfSeries& series);

}  // namespace vehd

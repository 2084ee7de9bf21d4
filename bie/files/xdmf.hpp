#pragma once

#include <string>
#include <vector>

#include "bie/sphere/grid.hpp"

namespace vehd {

/// Content of run.xdmf: the closed surfaces of every snapshot of a run.h5 beside it.
struct XdmfSeries {
  std::string heavy_data = "run.h5";
  Index n_points = 0;  ///< grid points and both poles
  Index n_triangles = 0;
  std::vector<std::string> scalars;  ///< names of the datasets under surface/
  std::vector<std::string> vectors;
  std::vector<double> times;   ///< of snapshots 000000, 000001, ...
  std::size_t n_vesicles = 1;  ///< of each snapshot
};

/// The XML text that ParaView opens.
std::string xdmf_text(const XdmfSeries& series);

}  // namespace vehd

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "bie/runs/run_directory.hpp"

namespace vehd {

/// The run to report, and the destination.
struct ReportTask {
  RunPaths paths;
  std::filesystem::path output;
  std::size_t most_snapshots = 200;  ///< in the page
};

/// Size of a report.
struct ReportSize {
  std::size_t snapshots = 0;  ///< in the page
  std::size_t all = 0;        ///< of the run
  std::size_t bytes = 0;
  std::vector<std::string> notes{};  ///< see ReadingNotes
};

/// Writes one self-contained HTML file: verdict, vesicle in 3D, shapes, histories, scene.
/// @throws InputError if the run cannot be read, OutputError if the file cannot be written
ReportSize write_report(const ReportTask& task);

}  // namespace vehd

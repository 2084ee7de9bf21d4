#include "bie/runs/run_units.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "bie/runs/history.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

OutputUnits units_of_run(const RunPaths& paths) {
  if (!std::filesystem::exists(paths.history()) || !std::filesystem::exists(paths.scene())) return {};
  // The headers alone: a kill can leave part of a row at the end.
  std::ifstream file(paths.history());
  std::string header;
  std::getline(file, header);
  std::istringstream first_line(header + "\n");
  const HistoryTable history(first_line, paths.history().string());
  return history.units(parse_units(text_of_file(paths.scene()), paths.scene().string()));
}

}  // namespace vehd

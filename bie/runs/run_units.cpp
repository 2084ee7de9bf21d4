#include "bie/runs/run_units.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "bie/runs/history.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

OutputUnits units_of_history(const std::filesystem::path& history, const std::optional<UnitsScene>& scales) {
  // The headers alone: a kill can leave part of a row at the end.
  std::ifstream file(history);
  std::string header;
  if (!std::getline(file, header)) return {};
  // Of several vesicles it has fewer columns than theirs.
  std::ifstream of_each(RunPaths{history.parent_path()}.vesicles());
  if (std::string further; std::getline(of_each, further)) header += "," + further;
  std::istringstream first_line(header + "\n");
  return HistoryTable(first_line, history.string()).units(scales);
}

OutputUnits units_of_run(const RunPaths& paths) {
  if (!std::filesystem::exists(paths.scene())) return {};
  const std::string scene = text_of_file(paths.scene());
  return units_of_history(paths.history(), parse_units(scene, paths.scene().string()));
}

}  // namespace vehd

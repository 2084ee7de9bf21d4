#include "bie/pictures/plots.hpp"

#include <fmt/format.h>

#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

void require_run(const RunPaths& paths) {
  if (!std::filesystem::exists(paths.snapshots())) {
    throw InputError(fmt::format("{}: holds no run (no run.h5)", paths.directory.string()));
  }
}

PlotResult plot_run(const PlotTask& task) {
  require_run(task.paths);
  make_directory(task.output);
  const auto file = [&](const char* stem) {
    return PictureFile{task.output / fmt::format("{}.{}", stem, name_of(task.format)), task.format};
  };
  PlotResult result = plot_shapes(task, file("shapes"));
  if (plot_history(task, file("history"))) result.pictures.push_back(file("history").path);
  return result;
}

}  // namespace vehd

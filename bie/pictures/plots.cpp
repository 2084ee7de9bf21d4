#include "bie/pictures/plots.hpp"

#include <fmt/format.h>

#include "bie/runs/history.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

std::vector<std::filesystem::path> plot_run(const PlotTask& task) {
  if (!std::filesystem::exists(task.paths.snapshots())) {
    throw InputError(fmt::format("{}: holds no run (no run.h5)", task.paths.directory.string()));
  }
  make_directory(task.output);
  std::vector<std::filesystem::path> pictures = {task.output / "shapes.png"};
  plot_shapes(task, pictures.back());
  if (HistoryTable(task.paths.history()).n_rows() > 1) {
    pictures.push_back(task.output / "history.png");
    plot_history(task, pictures.back());
  }
  return pictures;
}

}  // namespace vehd

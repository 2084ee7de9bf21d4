#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <tuple>

#include "bie/comparison/check.hpp"
#include "bie/python/arrays.hpp"
#include "bie/python/bindings.hpp"
#include "bie/python/scene_run.hpp"

namespace vehd::python {
namespace {

/// Exit code and result, as text, of the finite-element program; and a note where the time is not the one asked for.
std::tuple<int, std::string, std::string> check(const std::filesystem::path& program_folder,
                                                const std::filesystem::path& file,
                                                const std::vector<std::string>& settings,
                                                const std::filesystem::path& directory,
                                                const std::optional<std::string>& time, bool quick,
                                                const std::optional<double>& required, int ranks) {
  const FemProgram fem(program_folder);
  const CheckTask task{.frozen = read_frozen_state({file, settings}, time),
                       .directory = directory,
                       .quick = quick,
                       .required = required,
                       .n_ranks = ranks};
  const FemProgram::Result result = compare_methods(fem, task);
  return {static_cast<int>(result.code), result.json.dump(), task.frozen.note};
}

}  // namespace

void bind_check(py::module_& module) {
  module.def("check", &check, py::arg("program_folder"), py::arg("file"), py::arg("settings"), py::arg("directory"),
             py::arg("time"), py::arg("quick"), py::arg("required"), py::arg("ranks"),
             py::call_guard<py::gil_scoped_release>());
}

}  // namespace vehd::python

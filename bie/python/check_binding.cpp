#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <tuple>

#include "bie/comparison/check.hpp"
#include "bie/comparison/check_input.hpp"
#include "bie/python/arrays.hpp"
#include "bie/python/bindings.hpp"
#include "bie/support/file_system.hpp"

namespace vehd::python {

namespace py = pybind11;

namespace {

/// Exit code and result, as text, of the finite-element program.
std::tuple<int, std::string> solve_sources(const std::filesystem::path& program_folder, const Matrix& position,
                                           const GivenSources& sources, double conductivity_in, double conductivity_out,
                                           int degree, int cells, double radius) {
  const FemProgram fem(program_folder);
  const TemporaryFolder folder("vehd-sources");
  const std::filesystem::path input = folder.path() / "sources.h5";
  ElectricParameters electric;
  electric.conductivity_in = conductivity_in;
  electric.conductivity_out = conductivity_out;
  write_sources_input(input, position, electric, sources_of(sources));
  const FemProgram::Result result = fem.run({"sources", input.string(), "--degree", std::to_string(degree), "--cells",
                                             std::to_string(cells), "--radius", fmt::format("{}", radius)});
  return {static_cast<int>(result.code), result.json.dump()};
}

/// Exit code and result, as text, of the finite-element program; a note if the time is not the requested one; and the
/// time.
std::tuple<int, std::string, std::string, std::string> check(const std::filesystem::path& program_folder,
                                                             const std::filesystem::path& file,
                                                             const std::vector<std::string>& settings,
                                                             const std::filesystem::path& directory,
                                                             const std::optional<std::string>& time,
                                                             const std::optional<std::string>& from, bool quick,
                                                             const std::optional<double>& required, int ranks) {
  const FemProgram fem(program_folder);
  CheckTask task{.frozen = read_frozen_state({file, settings}, time),
                 .directory = directory,
                 .quick = quick,
                 .required = required,
                 .n_ranks = ranks};
  if (from) task.span = read_time_span(file, *from, task.frozen);
  const FemProgram::Result result = compare_methods(fem, task);
  return {static_cast<int>(result.code), result.json.dump(), fmt::format("{}", fmt::join(task.frozen.notes, "\n")),
          task.frozen.time_text};
}

}  // namespace

void bind_check(py::module_& module) {
  module.def("check", &check, py::arg("program_folder"), py::arg("file"), py::arg("settings"), py::arg("directory"),
             py::arg("time"), py::arg("from_time"), py::arg("quick"), py::arg("required"), py::arg("ranks"),
             py::call_guard<py::gil_scoped_release>());
  module.def("solve_sources_by_elements", &solve_sources, py::arg("program_folder"), py::arg("position"),
             py::arg("sources"), py::arg("conductivity_in"), py::arg("conductivity_out"), py::arg("degree"),
             py::arg("cells"), py::arg("radius"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace vehd::python

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>

#include "bie/fit/fit_output.hpp"
#include "bie/fit/fit_picture.hpp"
#include "bie/python/bindings.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd::python {

namespace py = pybind11;

namespace {

/// Content of fit.json.
/// @param text  content of the fit file; absent: read from the file
std::string fit(const std::filesystem::path& file, const std::optional<std::string>& text,
                const std::filesystem::path& directory, int jobs, bool plot) {
  const ThreadCount one(1);
  const FitFile read = text ? parse_fit(*text, file.string(), file.parent_path()) : read_fit(file);
  Interruption interruption;
  const FitResult result = fit_keys(read, ModelRuns(read.experiments, {directory, jobs}, interruption));
  const FitPaths paths{directory};
  write_fit(paths, read, result);
  if (plot) draw_fit(read, result, {paths.picture(), PictureFormat::png});
  return json_of(read, result).dump();
}

}  // namespace

void bind_fit(py::module_& module) {
  py::register_exception<Interrupted>(module, "Interrupted", PyExc_KeyboardInterrupt);
  module.def("fit", &fit, py::arg("file"), py::arg("text"), py::arg("directory"), py::arg("jobs"), py::arg("plot"),
             py::call_guard<py::gil_scoped_release>());
}

}  // namespace vehd::python

#include <omp.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "bie/files/versions.hpp"
#include "bie/python/bindings.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/memory.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd::python {

namespace py = pybind11;

void bind_errors(py::module_& module) {
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<ShapeError>(module, "ShapeError", PyExc_ValueError);
  py::register_exception<OutputError>(module, "OutputError", PyExc_OSError);
  py::register_exception<ConvergenceError>(module, "ConvergenceError", PyExc_RuntimeError);
}

}  // namespace vehd::python

PYBIND11_MODULE(_core, module) {
  using namespace vehd::python;
  vehd::keep_freed_memory();
  module.doc() = "Compiled part of vehd: import vehd instead.";
  bind_errors(module);
  bind_scene(module);
  bind_simulation(module);
  bind_surface(module);
  bind_layers(module);
  bind_solves(module);
  bind_check(module);
  bind_fit(module);
  module.def("version", &vehd::program_version, "Version of vehd.");
  module.def("library_versions", &vehd::library_versions, "Versions of the libraries that results depend on, by name.");
  module.attr("most_threads") = vehd::most_threads;
  module.def(
      "set_threads", [](int count) { omp_set_num_threads(count); }, pybind11::arg("count"));
  module.def(
      "threads", [] { return omp_get_max_threads(); }, "Number of threads.");
}

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <memory>

#include "bie/python/arrays.hpp"
#include "bie/python/bindings.hpp"
#include "bie/python/scene_run.hpp"
#include "bie/runs/run_files.hpp"

namespace vehd::python {
namespace {

/// One vesicle of a moment.
struct Vesicle {
  std::shared_ptr<StateView> moment;
  std::size_t number;
};

std::size_t count_of(const StateView& moment) {
  return moment.with([](const State& state, const Fields&) { return state.vesicles.size(); });
}

/// A property: an array that shares a field of the state.
template <auto member>
py::object of_state(const Vesicle& vesicle) {
  return vesicle.moment->with([&](const State& state, const Fields&) {
    return view(state.vesicles[vesicle.number].*member, py::cast(vesicle.moment));
  });
}

/// A property: an array that shares a solved field.
template <auto member>
py::object of_fields(const Vesicle& vesicle) {
  return vesicle.moment->with([&](const State&, const Fields& fields) {
    return view(fields.vesicles[vesicle.number].*member, py::cast(vesicle.moment));
  });
}

py::dict columns_of(const HistoryTable& table) {
  py::dict columns;
  for (const std::string& name : table.names()) {
    const std::vector<double>& values = table.column(name);
    columns[py::str(name)] = py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  }
  return columns;
}

/// A table of a run, with a warning if it cannot be verified to be intact.
HistoryTable checked_table(const std::filesystem::path& path) {
  ReadingNotes notes;
  HistoryTable table = read_table(path, notes);
  for (const std::string& note : notes) {
    if (PyErr_WarnEx(PyExc_UserWarning, note.c_str(), 1) != 0) throw py::error_already_set();
  }
  return table;
}

py::dict units_of(const HistoryTable& table) {
  py::dict units;
  for (const std::string& name : table.names()) units[py::str(name)] = table.unit(name);
  return units;
}

/// Addresses of the fields of a vesicle in the solver, by the names of the arrays that share them: for tests.
py::dict addresses_of(const SceneRun& run, std::size_t number) {
  const SurfaceFields& state = run.simulation().evolution().state().vesicles.at(number);
  const VesicleFields& fields = run.simulation().evolution().evaluation().fields.vesicles.at(number);
  py::dict addresses;
  const auto add = [&](const char* name, const auto& values) {
    if (values.size() > 0) addresses[name] = reinterpret_cast<std::uintptr_t>(values.data());
  };
  add("position", state.position);
  add("area_strain", state.area_strain);
  add("Vm", state.transmembrane_potential);
  add("velocity", fields.velocity);
  add("tension", fields.tension);
  add("q", fields.charge);
  add("force_bending", fields.force_bending);
  add("force_tension", fields.force_tension);
  add("force_electric", fields.force_electric);
  return addresses;
}

/// Takes a step without the lock of Python; a signal received meanwhile raises once the step is complete.
bool step(SceneRun& run) {
  bool stepped = false;
  {
    const py::gil_scoped_release others_run;
    stepped = run.step();
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return stepped;
}

void bind_moment(py::module_& module) {
  py::class_<Vesicle>(module, "Vesicle")
      .def_property_readonly("position", of_state<&SurfaceFields::position>)
      .def_property_readonly("area_strain", of_state<&SurfaceFields::area_strain>)
      .def_property_readonly("Vm", of_state<&SurfaceFields::transmembrane_potential>)
      .def_property_readonly("velocity", of_fields<&VesicleFields::velocity>)
      .def_property_readonly("tension", of_fields<&VesicleFields::tension>)
      .def_property_readonly("q", of_fields<&VesicleFields::charge>)
      .def_property_readonly("force_bending", of_fields<&VesicleFields::force_bending>)
      .def_property_readonly("force_tension", of_fields<&VesicleFields::force_tension>)
      .def_property_readonly("force_electric", of_fields<&VesicleFields::force_electric>)
      .def_property_readonly("force_contact", of_fields<&VesicleFields::force_contact>);
  py::class_<StateView, std::shared_ptr<StateView>>(module, "State")
      .def_property_readonly("time", &StateView::time)
      .def("__len__", [](const std::shared_ptr<StateView>& moment) { return count_of(*moment); })
      .def("__getitem__", [](const std::shared_ptr<StateView>& moment, py::ssize_t number) {
        const auto count = static_cast<py::ssize_t>(count_of(*moment));
        if (number < 0) number += count;
        if (number < 0 || number >= count) throw py::index_error("no such vesicle");
        return Vesicle{moment, static_cast<std::size_t>(number)};
      });
}

}  // namespace

void bind_simulation(py::module_& module) {
  bind_moment(module);
  py::class_<RunStatus>(module, "Status")
      .def_readonly("step", &RunStatus::step)
      .def_readonly("time", &RunStatus::time)
      .def_readonly("end_time", &RunStatus::end_time)
      .def_readonly("dt", &RunStatus::dt)
      .def_readonly("drift", &RunStatus::drift)
      .def_readonly("seconds", &RunStatus::seconds)
      .def_readonly("time_unit", &RunStatus::time_unit);
  py::class_<HistoryTable>(module, "HistoryTable")
      .def(py::init(&checked_table), py::arg("path"))
      .def("columns", &columns_of)
      .def("units", &units_of);
  py::class_<SceneRun>(module, "SceneRun")
      .def(py::init([](const GivenScene& scene, const std::optional<std::filesystem::path>& directory, bool resume,
                       const std::filesystem::path& from) {
             const py::gil_scoped_release others_run;
             return std::make_unique<SceneRun>(scene, directory, resume, from);
           }),
           py::arg("scene"), py::arg("directory") = std::nullopt, py::arg("resume") = false,
           py::arg("from_run") = std::filesystem::path())
      .def("step", &step)
      .def("snapshot", &SceneRun::snapshot, py::call_guard<py::gil_scoped_release>())
      .def("close", &SceneRun::close, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("completed", &SceneRun::completed)
      .def_property_readonly("closed", &SceneRun::closed)
      .def_property_readonly("status", &SceneRun::status)
      .def_property_readonly("state", &SceneRun::moment)
      .def_property_readonly("directory", &SceneRun::directory)
      .def("history", &SceneRun::history)
      .def("addresses", &addresses_of, py::arg("vesicle"))
      .def("vesicle_history", &SceneRun::vesicle_history);
}

}  // namespace vehd::python

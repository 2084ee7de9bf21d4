#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <toml++/toml.h>

#include <sstream>

#include "bie/python/arrays.hpp"
#include "bie/python/bindings.hpp"
#include "bie/python/scene_run.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/support/errors.hpp"

namespace vehd::python {
namespace {

/// An error in a scene, with a separate exception type in Python.
class SceneProblem : public InputError {
 public:
  using InputError::InputError;
};

/// Calls `read` and rethrows its errors as those of a scene.
template <typename Read>
GivenScene read_given(SceneSource source, const Read& read) {
  try {
    Scene scene = read(source);
    return {std::move(source), std::move(scene)};
  } catch (const InputError& error) {
    throw SceneProblem(error.what());
  }
}

GivenScene given(SceneSource source) {
  return read_given(std::move(source), [](const SceneSource& from) { return read_scene(from); });
}

toml::table table_of(const py::dict& dict);
toml::array array_of(py::handle list, const std::string& name);

/// A Python value as a C++ type. @throws SceneProblem if it does not fit
template <typename T>
T fitting(py::handle value, const std::string& name, const char* accepted) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw SceneProblem(
        fmt::format("{}: \"{}\" is {}; accepted: {}", name, name, std::string(py::repr(value)), accepted));
  }
}

/// Counts one more level of nesting in Python during its lifetime.
class Level {
 public:
  Level() {
    if (Py_EnterRecursiveCall(" in the tables of a scene") != 0) throw py::error_already_set();
  }
  ~Level() { Py_LeaveRecursiveCall(); }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;
};

/// Calls `take` with the value in its TOML type.
template <typename Take>
void with_value(py::handle value, const std::string& name, const Take& take) {
  if (py::hasattr(value, "dtype") && value.attr("ndim").cast<int>() == 0) {
    // A numpy number becomes the Python number; one of extended precision stays unchanged.
    const py::object plain = value.attr("item")();
    if (!plain.get_type().is(value.get_type())) return with_value(plain, name, take);
  }
  if (py::isinstance<py::bool_>(value)) return take(value.cast<bool>());
  if (py::isinstance<py::str>(value)) return take(fitting<std::string>(value, name, "text of Unicode characters"));
  if (py::isinstance<py::dict>(value)) return take(table_of(value.cast<py::dict>()));
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) || py::isinstance<py::array>(value)) {
    return take(array_of(value, name));
  }
  // Any other number.
  if (PyIndex_Check(value.ptr()) != 0)
    return take(
        fitting<std::int64_t>(py::int_(py::reinterpret_borrow<py::object>(value)), name, "whole numbers of 64 bits"));
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw SceneProblem(fmt::format("{}: \"{}\" is a {}; accepted: a number, text, list or dict", name, name,
                                   std::string(py::str(py::type::of(value).attr("__name__")))));
  }
  take(number);
}

toml::array array_of(py::handle list, const std::string& name) {
  const Level level;
  toml::array array;
  for (const py::handle item : list) with_value(item, name, [&](const auto& entry) { array.push_back(entry); });
  return array;
}

toml::table table_of(const py::dict& dict) {
  const Level level;
  toml::table table;
  for (const auto& [key, value] : dict) {
    const auto name = fitting<std::string>(py::str(key), "dict", "keys of Unicode characters");
    if (name.find_first_of("\n\t") != std::string::npos) {
      // toml++ may write them without quotes.
      throw SceneProblem(fmt::format("dict: {} is a key; accepted: keys without line breaks and tabs",
                                     std::string(py::repr(py::str(key)))));
    }
    with_value(value, name, [&](const auto& entry) { table.insert(name, entry); });
  }
  return table;
}

GivenScene scene_of_dict(const py::dict& dict, const std::filesystem::path& folder) {
  std::ostringstream text;
  text << toml::toml_formatter(table_of(dict)) << "\n";
  return given({folder / "dict", {}, text.str()});
}

}  // namespace

void bind_scene(py::module_& module) {
  py::register_exception<SceneProblem>(module, "SceneError", module.attr("InputError"));
  py::class_<GivenScene>(module, "Scene")
      .def(py::init([](const std::filesystem::path& path, const std::vector<std::string>& settings) {
             return given({path, settings});
           }),
           py::arg("path"), py::arg("settings") = std::vector<std::string>())
      .def_static(
          "from_text",
          [](const std::string& text, const std::string& name, const std::filesystem::path& folder,
             const std::vector<std::string>& settings) {
            return given({folder / name, settings, text});
          },
          py::arg("text"), py::arg("name") = "scene", py::arg("folder") = std::filesystem::path(),
          py::arg("settings") = std::vector<std::string>())
      .def_static("from_dict", &scene_of_dict, py::arg("tables"), py::arg("folder") = std::filesystem::path())
      .def_property_readonly("text", [](const GivenScene& s) { return effective_scene(s.scene); })
      .def_property_readonly(
          "source",
          [](const GivenScene& s) { return s.source.text ? py::object(py::cast(*s.source.text)) : py::none(); })
      .def_property_readonly("path", [](const GivenScene& s) { return s.source.file; })
      .def_property_readonly("end_time", [](const GivenScene& s) { return s.scene.numerics.end_time; })
      .def_property_readonly("degree", [](const GivenScene& s) { return s.scene.numerics.order; })
      .def_property_readonly("n_vesicles", [](const GivenScene& s) { return n_vesicles(s.scene); })
      .def("__eq__", [](const GivenScene& a, const GivenScene& b) { return a.scene == b.scene; })
      .def(
          "position",
          [](const GivenScene& s, std::size_t vesicle) {
            if (vesicle >= n_vesicles(s.scene)) throw py::index_error("no such vesicle");
            return view(initial_position(alone(s.scene, vesicle)), py::none()).attr("copy")();
          },
          py::arg("vesicle") = 0);
}

}  // namespace vehd::python

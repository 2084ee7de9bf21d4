#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "bie/potentials/off_surface.hpp"
#include "bie/python/arrays.hpp"
#include "bie/python/bindings.hpp"
#include "bie/python/surface_object.hpp"
#include "bie/support/errors.hpp"

namespace vehd::python {
namespace {

/// Coefficients of an optional density; empty if it is absent.
Matrix density_of(const SurfaceObject& surface, const std::optional<Matrix>& given, const char* name, Index columns) {
  if (!given) return {};
  require_size(name, given->rows(), surface.coefficients().rows());
  require_size(name, given->cols(), columns);
  return *given;
}

OffSurfaceValues evaluated(const std::shared_ptr<SurfaceObject>& surface, const Matrix& points,
                           const std::optional<Matrix>& single, const std::optional<Matrix>& double_layer,
                           const std::optional<Matrix>& stokes_single, const std::optional<Matrix>& stokes_double,
                           bool weighted, bool gradients, Side side, double tolerance) {
  require_size("points (components)", points.cols(), 3);
  LayerDensities densities;
  if (single) densities.laplace_single = density_of(*surface, single, "single", 1);
  if (double_layer) densities.laplace_double = density_of(*surface, double_layer, "double", 1);
  if (stokes_single) densities.stokes_single = density_of(*surface, stokes_single, "stokes_single", 3);
  if (stokes_double) densities.stokes_double = density_of(*surface, stokes_double, "stokes_double", 3);
  densities.gradients = gradients;
  densities.plain = !weighted;
  const OffSurfaceLayers layers(surface->coefficients(), std::move(densities), {.tolerance = tolerance});
  Instruments instruments;
  return layers.evaluate(points, side, instruments);
}

/// Two properties of a layer: its values and their error.
template <auto member>
py::object values_of(const OffSurfaceValues& values) {
  const Matrix& found = (values.*member).values;
  if (found.cols() == 0) return py::none();
  if (found.cols() == 1) return py::cast(Vector(found.col(0)));
  return py::cast(found);
}
template <auto member>
py::object error_of(const OffSurfaceValues& values) {
  return (values.*member).values.cols() == 0 ? py::object(py::none()) : py::cast((values.*member).error);
}

}  // namespace

void bind_layers(py::module_& module) {
  py::enum_<Layer>(module, "Layer")
      .value("single", Layer::single)
      .value("double_layer", Layer::double_layer)
      .value("adjoint", Layer::adjoint)
      .value("hypersingular", Layer::hypersingular)
      .value("stokes_single", Layer::stokes_single)
      .value("stokes_double", Layer::stokes_double);
  py::enum_<Side>(module, "Side")
      .value("interior", Side::interior)
      .value("exterior", Side::exterior)
      .value("principal_value", Side::principal_value);
  py::class_<LayerMatrix>(module, "LayerMatrix")
      .def(py::init<std::shared_ptr<SurfaceObject>, Layer, bool>(), py::arg("surface"), py::arg("layer"),
           py::arg("weighted"), py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("size", &LayerMatrix::size)
      .def(
          "apply",
          [](const LayerMatrix& layer, const py::array_t<double>& density) {
            return shaped_like(density, layer.apply(density.cast<Matrix>()));
          },
          py::arg("density"))
      .def("matrix", &LayerMatrix::matrix, py::call_guard<py::gil_scoped_release>());
  using O = OffSurfaceValues;
  py::class_<O>(module, "OffSurfaceValues")
      .def_property_readonly("single", &values_of<&O::laplace_single>)
      .def_property_readonly("single_gradient", &values_of<&O::laplace_single_gradient>)
      .def_property_readonly("double", &values_of<&O::laplace_double>)
      .def_property_readonly("double_gradient", &values_of<&O::laplace_double_gradient>)
      .def_property_readonly("stokes_single", &values_of<&O::stokes_single>)
      .def_property_readonly("stokes_double", &values_of<&O::stokes_double>)
      .def_property_readonly("single_error", &error_of<&O::laplace_single>)
      .def_property_readonly("single_gradient_error", &error_of<&O::laplace_single_gradient>)
      .def_property_readonly("double_error", &error_of<&O::laplace_double>)
      .def_property_readonly("double_gradient_error", &error_of<&O::laplace_double_gradient>)
      .def_property_readonly("stokes_single_error", &error_of<&O::stokes_single>)
      .def_property_readonly("stokes_double_error", &error_of<&O::stokes_double>)
      .def_property_readonly("inside",
                             [](const O& values) {
                               py::array_t<bool> inside(static_cast<py::ssize_t>(values.side.size()));
                               for (std::size_t i = 0; i < values.side.size(); ++i) {
                                 inside.mutable_data()[i] = values.side[i] == Side::interior;
                               }
                               return inside;
                             })
      .def_property_readonly("distance", [](const O& values) { return values.distance; })
      .def_property_readonly("resolved", [](const O& values) { return values.resolved; });
  module.def("evaluate_layers", &evaluated, py::arg("surface"), py::arg("points"), py::arg("single") = std::nullopt,
             py::arg("double") = std::nullopt, py::arg("stokes_single") = std::nullopt,
             py::arg("stokes_double") = std::nullopt, py::arg("weighted") = false, py::arg("gradients") = false,
             py::arg("side") = Side::principal_value, py::arg("tolerance") = 1e-9,
             py::call_guard<py::gil_scoped_release>());
}

}  // namespace vehd::python

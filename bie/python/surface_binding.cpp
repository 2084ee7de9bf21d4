#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <memory>
#include <utility>

#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/tension.hpp"
#include "bie/python/arrays.hpp"
#include "bie/python/bindings.hpp"
#include "bie/python/surface_object.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd::python {
namespace {

using Shared = std::shared_ptr<SurfaceObject>;

/// A property: an array that shares a field of the geometry.
template <auto member>
py::object of_geometry(const Shared& surface) {
  return view(surface->geometry().*member, py::cast(surface));
}

/// A property: an array that shares a field of the grid.
template <auto member>
py::object of_grid(const Shared& surface) {
  return view(surface->transform().grid().*member, py::cast(surface));
}

Index n_points(const Shared& surface) { return surface->geometry().n_points(); }
Index n_of(const Shared& surface) { return surface->coefficients().rows(); }

py::object integral(const Shared& surface, const py::array_t<double>& values) {
  const auto given = values.cast<Matrix>();
  require_size("values (points)", given.rows(), n_points(surface));
  const Vector sums = given.transpose() * surface->geometry().quadrature;
  if (values.ndim() == 1) return py::float_(sums[0]);
  return py::cast(sums);
}

py::object synthesized(const Shared& surface, const py::array_t<double>& coefficients) {
  const auto given = coefficients.cast<Matrix>();
  require_size("coefficients (rows)", given.rows(), n_of(surface));
  return shaped_like(coefficients, surface->transform().synthesize(given));
}

py::object analyzed(const Shared& surface, const py::array_t<double>& values) {
  const auto given = values.cast<Matrix>();
  require_size("values (points)", given.rows(), n_points(surface));
  return shaped_like(values, surface->transform().analyze(given));
}

Matrix gradient(const Shared& surface, const Vector& scalar) {
  require_size("scalar (coefficients)", scalar.size(), n_of(surface));
  return surface_gradient(surface->geometry(), surface->transform().synthesize_gradient(scalar));
}

Vector divergence(const Shared& surface, const Matrix& vector) {
  require_size("vector (coefficients)", vector.rows(), n_of(surface));
  require_size("vector (components)", vector.cols(), 3);
  return surface_divergence(surface->geometry(), surface->transform().synthesize_gradient(vector));
}

py::object laplacian(const Shared& surface, const py::array_t<double>& fields) {
  const auto given = fields.cast<Matrix>();
  require_size("fields (coefficients)", given.rows(), n_of(surface));
  return shaped_like(fields, surface_laplacian(surface->geometry(), surface->transform().synthesize_hessian(given)));
}

/// The membrane without operators, which forces of the shape do not need.
const Membrane& bare(const Shared& surface) { return surface->with({}); }

}  // namespace

void bind_surface(py::module_& module) {
  module.def("n_coefficients", &n_coefficients, py::arg("degree"));
  module.def("coefficient_index", &coefficient_index, py::arg("n"), py::arg("m"));
  module.def("degree_of", &degree_of, py::arg("index"));
  module.def(
      "evaluate_harmonics",
      [](const py::array_t<double>& coefficients, const Vector& theta, const Vector& phi) {
        return shaped_like(coefficients, evaluate_harmonics(coefficients.cast<Matrix>(), theta, phi));
      },
      py::arg("coefficients"), py::arg("theta"), py::arg("phi"));
  module.def(
      "resize_degree",
      [](const py::array_t<double>& coefficients, int degree) {
        return shaped_like(coefficients, resize_order(coefficients.cast<Matrix>(), degree));
      },
      py::arg("coefficients"), py::arg("degree"));
  py::class_<SurfaceObject, Shared>(module, "Surface")
      .def(py::init([](Matrix coefficients, int upsampling, double quadrature) {
             return std::make_shared<SurfaceObject>(std::move(coefficients),
                                                    SurfaceObject::ResolutionLevel{upsampling, quadrature});
           }),
           py::arg("coefficients"), py::arg("upsampling") = 2, py::arg("quadrature") = 1.15)
      .def_property_readonly("degree", &SurfaceObject::order)
      .def_property_readonly("coefficients", [](const Shared& s) { return view(s->coefficients(), py::cast(s)); })
      .def_property_readonly("theta", of_grid<&SphereGrid::theta>)
      .def_property_readonly("phi", of_grid<&SphereGrid::phi>)
      .def_property_readonly("shape",
                             [](const Shared& s) {
                               const SphereGrid& grid = s->transform().grid();
                               return py::make_tuple(grid.n_theta, grid.n_phi);
                             })
      .def_property_readonly("position", of_geometry<&Surface::position>)
      .def_property_readonly("normal", of_geometry<&Surface::normal>)
      .def_property_readonly("mean_curvature", of_geometry<&Surface::mean_curvature>)
      .def_property_readonly("gauss_curvature", of_geometry<&Surface::gauss_curvature>)
      .def_property_readonly("area_element", of_geometry<&Surface::area_element>)
      .def_property_readonly("weight", of_geometry<&Surface::quadrature>)
      .def_property_readonly("area", [](const Shared& s) { return surface_area(s->geometry()); })
      .def_property_readonly("volume", [](const Shared& s) { return enclosed_volume(s->geometry()); })
      .def_property_readonly("centroid", [](const Shared& s) { return Vector3(centroid(s->geometry())); })
      .def_property_readonly("bending_energy_scaled",
                             [](const Shared& s) { return bending_energy_scaled(s->geometry()); })
      .def("integrate", &integral, py::arg("values"))
      .def("synthesize", &synthesized, py::arg("coefficients"))
      .def("analyze", &analyzed, py::arg("values"))
      .def("gradient", &gradient, py::arg("scalar"))
      .def("divergence", &divergence, py::arg("vector"))
      .def("laplacian", &laplacian, py::arg("fields"))
      .def(
          "bending_force", [](const Shared& s, double modulus) { return bending_force({modulus}, bare(s)); },
          py::arg("modulus") = 1.0)
      .def(
          "tension_force",
          [](const Shared& s, const Vector& tension) {
            require_size("tension (coefficients)", tension.size(), n_of(s));
            return tension_force(bare(s), tension);
          },
          py::arg("tension"));
}

}  // namespace vehd::python

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <utility>

#include "bie/bench/exact_problems.hpp"
#include "bie/physics/electric.hpp"
#include "bie/python/arrays.hpp"
#include "bie/python/bindings.hpp"
#include "bie/python/surface_object.hpp"
#include "bie/stepping/solve/flow_equations.hpp"
#include "bie/stepping/solve/tension_solve.hpp"
#include "bie/support/errors.hpp"

namespace vehd::python {
namespace {

using Shared = std::shared_ptr<SurfaceObject>;

/// A solved electric problem.
struct ElectricSolution {
  ElectricTraces traces;
  Matrix force;
  SolveReport report;
};

/// A solved tension problem.
struct TensionSolution {
  Vector tension;
  Matrix velocity;
  SolveReport report;
};

Vector potential_of(const SurfaceObject& surface, const std::optional<Vector>& given) {
  const Index n = surface.coefficients().rows();
  if (!given) return Vector::Zero(n);
  require_size("potential (coefficients)", given->size(), n);
  return *given;
}

ElectricSolution solve_electric(const Shared& surface, const Vector3& field, double conductivity_in,
                                double conductivity_out, const std::optional<Vector>& potential, double permittivity,
                                double permittivity_ratio, double tolerance) {
  ElectricParameters electric;
  electric.field = field;
  electric.conductivity_in = conductivity_in;
  electric.conductivity_out = conductivity_out;
  const Vector jump = potential_of(*surface, potential);
  const Membrane& membrane = surface->with({.laplace_single = true, .laplace_double = true, .laplace_adjoint = true});
  const Vector rhs = weighted_field_flux(membrane, field) + weighted_hypersingular(membrane, jump);
  const SecondKindSolution density = solve_second_kind(membrane, conductivity_contrast(electric), rhs, tolerance);
  require_converged(density.report, "charge density, Eq. (12)");
  ElectricTraces traces = electric_traces(electric, membrane, jump, density);
  Matrix force = electric_force(permittivity, membrane, traces, permittivity_ratio);
  return {std::move(traces), std::move(force), density.report};
}

ElectricSolution solve_electric_jumps(const Shared& surface, const Vector& potential, const Vector& current,
                                      double conductivity_in, double conductivity_out, double permittivity,
                                      double tolerance) {
  ElectricParameters electric;
  electric.conductivity_in = conductivity_in;
  electric.conductivity_out = conductivity_out;
  const Membrane& membrane = surface->with({.laplace_single = true, .laplace_double = true, .laplace_adjoint = true});
  require_size("current (points)", current.size(), membrane.surface.n_points());
  JumpSolution solution = solve_jumps(electric, membrane, potential_of(*surface, potential), current, tolerance);
  require_converged(solution.report, "charge density, Eq. (35)");
  Matrix force = electric_force(permittivity, membrane, solution.traces);
  return {std::move(solution.traces), std::move(force), solution.report};
}

TensionSolution solve_tension(const Shared& surface, const Matrix& velocity, double viscosity, double tolerance) {
  require_size("velocity (coefficients)", velocity.rows(), surface->coefficients().rows());
  require_size("velocity (components)", velocity.cols(), 3);
  const Membrane& membrane = surface->with({.stokes_single = true});
  const FlowParameters flow{.viscosity = viscosity};
  const std::vector<FlowMembrane> alone{{flow, membrane}};
  const Interaction none;
  MembraneFlow map(alone, none);
  SolvedTensions solution = solve_tensions(alone, {uniform_tension_is_free(flow, membrane)}, map, {Matrix()},
                                           {velocity}, {Vector()}, {RecycledSubspace{}}, tolerance);
  require_converged(solution.report, "tension, Eq. (27b)");
  return {std::move(solution.tension.front()), std::move(solution.velocities.front()), solution.report};
}

template <auto member>
Vector trace(const ElectricSolution& solution) {
  return solution.traces.*member;
}

}  // namespace

void bind_solves(py::module_& module) {
  using E = ElectricSolution;
  using T = TensionSolution;
  py::class_<E>(module, "ElectricSolution")
      .def_property_readonly("charge", trace<&ElectricTraces::charge>)
      .def_property_readonly("flux_in", trace<&ElectricTraces::flux_in>)
      .def_property_readonly("flux_out", trace<&ElectricTraces::flux_out>)
      .def_property_readonly("potential_in", trace<&ElectricTraces::potential_in>)
      .def_property_readonly("potential_out", trace<&ElectricTraces::potential_out>)
      .def_property_readonly("force", [](const E& solution) { return solution.force; })
      .def_property_readonly("iterations", [](const E& solution) { return solution.report.iterations; })
      .def_property_readonly("residual", [](const E& solution) { return solution.report.residual; });
  py::class_<T>(module, "TensionSolution")
      .def_property_readonly("tension", [](const T& solution) { return solution.tension; })
      .def_property_readonly("velocity", [](const T& solution) { return solution.velocity; })
      .def_property_readonly("iterations", [](const T& solution) { return solution.report.iterations; })
      .def_property_readonly("residual", [](const T& solution) { return solution.report.residual; });
  module.def("solve_electric", &solve_electric, py::arg("surface"), py::arg("field"), py::arg("conductivity_in"),
             py::arg("conductivity_out"), py::arg("potential") = std::nullopt, py::arg("permittivity") = 1.0,
             py::arg("permittivity_ratio") = 1.0, py::arg("tolerance") = 1e-10,
             py::call_guard<py::gil_scoped_release>());
  module.def("solve_jumps", &solve_electric_jumps, py::arg("surface"), py::arg("potential"), py::arg("current"),
             py::arg("conductivity_in"), py::arg("conductivity_out"), py::arg("permittivity") = 1.0,
             py::arg("tolerance") = 1e-10, py::call_guard<py::gil_scoped_release>());
  module.def("solve_tension", &solve_tension, py::arg("surface"), py::arg("velocity"), py::arg("viscosity") = 1.0,
             py::arg("tolerance") = 1e-9, py::call_guard<py::gil_scoped_release>());
  module.def(
      "point_source_fields",
      [](const Shared& surface, const GivenSources& sources) {
        PointSourceFields fields = point_source_fields(sources_of(sources), surface->geometry());
        py::dict result;
        result["potential_in"] = std::move(fields.potential_in);
        result["potential_out"] = std::move(fields.potential_out);
        result["gradient_in"] = std::move(fields.gradient_in);
        result["gradient_out"] = std::move(fields.gradient_out);
        result["flux_in"] = std::move(fields.flux_in);
        result["flux_out"] = std::move(fields.flux_out);
        return result;
      },
      py::arg("surface"), py::arg("sources"));
  module.def("example1_sources", [] {
    GivenSources sources;
    for (const PointSource& source : example1_sources()) {
      sources.emplace_back(source.position, source.strength, source.inside);
    }
    return sources;
  });
}

}  // namespace vehd::python

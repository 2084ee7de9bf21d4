#pragma once

#include <pybind11/pybind11.h>

/// One function for each part of the module `vehd._core`, which adds types and functions of this part.
namespace vehd::python {

/// Exceptions; must be called first.
void bind_errors(pybind11::module_& module);
/// Scene.
void bind_scene(pybind11::module_& module);
/// Simulation, State, Vesicle, Status, tables of histories.
void bind_simulation(pybind11::module_& module);
/// Surface and harmonics.
void bind_surface(pybind11::module_& module);
/// Layer operators and fields off the surface.
void bind_layers(pybind11::module_& module);
/// Electric and tension problems on a frozen surface.
void bind_solves(pybind11::module_& module);
/// The check by finite elements.
void bind_check(pybind11::module_& module);
/// Fits to measured data.
void bind_fit(pybind11::module_& module);

}  // namespace vehd::python

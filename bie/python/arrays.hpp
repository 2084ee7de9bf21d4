#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <tuple>
#include <vector>

#include "bie/physics/point_sources.hpp"
#include "bie/support/types.hpp"

namespace vehd::python {

namespace py = pybind11;

/// Read-only numpy array that shares the numbers of a vector or a matrix without a copy.
/// @param owner  Python object that keeps the numbers alive as long as the array exists
/// @return  [n] for a vector; [n, columns] for a matrix, whose columns are contiguous; None if it is empty
py::object view(const Vector& values, py::handle owner);
/// The array of a matrix, [n, columns]; owner as above.
py::object view(const Matrix& values, py::handle owner);

/// A result with one axis if the argument from which it was computed has one, otherwise with two.
py::object shaped_like(const py::array& argument, Matrix result);

/// Point sources in Python: position, strength, whether inside.
using GivenSources = std::vector<std::tuple<Vector3, double, bool>>;

inline std::vector<PointSource> sources_of(const GivenSources& given) {
  std::vector<PointSource> sources;
  for (const auto& [position, strength, inside] : given) sources.push_back({position, strength, inside});
  return sources;
}

}  // namespace vehd::python

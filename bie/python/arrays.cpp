#include "bie/python/arrays.hpp"

#include <pybind11/eigen.h>

#include <utility>
#include <vector>

namespace vehd::python {
namespace {

py::object locked(const double* numbers, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                  py::handle owner) {
  py::array array(py::dtype::of<double>(), std::move(shape), std::move(strides), numbers, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

constexpr py::ssize_t number_size = sizeof(double);

}  // namespace

py::object view(const Vector& values, py::handle owner) {
  if (values.size() == 0) return py::none();
  return locked(values.data(), {values.size()}, {number_size}, owner);
}

py::object view(const Matrix& values, py::handle owner) {
  if (values.size() == 0) return py::none();
  return locked(values.data(), {values.rows(), values.cols()}, {number_size, number_size * values.rows()}, owner);
}

py::object shaped_like(const py::array& argument, Matrix result) {
  if (argument.ndim() == 1) return py::cast(Vector(result.reshaped()));
  return py::cast(std::move(result));
}

}  // namespace vehd::python

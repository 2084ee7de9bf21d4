#include "bie/pictures/shape_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "bie/geometry/surface.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/surface_mesh.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Forces that a snapshot may have; the electric one is that on the membrane's charges, which the membrane hands on.
constexpr std::array forces = {std::pair{"force_bending", 1.0}, std::pair{"force_tension", 1.0},
                               std::pair{"force_electric", -1.0}};

bool has(const RunReader& run, std::size_t snapshot, ShapeField field) {
  switch (field) {
    case ShapeField::potential:
      return run.has_field(snapshot, "Vm");
    case ShapeField::charge:
      return run.has_field(snapshot, "q");
    case ShapeField::tension:
      return run.has_field(snapshot, "tension");
    case ShapeField::force:
      return std::ranges::any_of(forces, [&](const auto& force) { return run.has_field(snapshot, force.first); });
    case ShapeField::none:
    case ShapeField::curvature:
      break;
  }
  return true;
}

Vector values_of(const ShapeCoefficients& read, ShapeField field, const SphereTransform& transform,
                 const Surface& surface) {
  switch (field) {
    case ShapeField::potential:
    case ShapeField::charge:
    case ShapeField::tension:
      return transform.synthesize(read.field).col(0);
    case ShapeField::force:
      return transform.synthesize(read.field).rowwise().norm();
    case ShapeField::curvature:
      return surface.mean_curvature;
    case ShapeField::none:
      break;
  }
  return Vector::Zero(surface.n_points());
}

/// Values on the grid, then means of the circles next to the north and the south pole.
Matrix with_mean_poles(const Matrix& values, int n_phi) {
  Matrix result(values.rows() + 2, values.cols());
  result.topRows(values.rows()) = values;
  result.row(values.rows()) = values.topRows(n_phi).colwise().mean();
  result.row(values.rows() + 1) = values.bottomRows(n_phi).colwise().mean();
  return result;
}

}  // namespace

FieldLabel label_of(ShapeField field) {
  switch (field) {
    case ShapeField::potential:
      return {"V_m", "potential", "Vm", true};
    case ShapeField::charge:
      return {"q", "potential/length", "q", true};
    case ShapeField::tension:
      return {"tension λ", "force/length", "tension"};
    case ShapeField::force:
      return {"force |f|", "force/area"};
    case ShapeField::curvature:
      return {"curvature H", "1/length"};
    case ShapeField::none:
      break;
  }
  return {"", "1"};
}

ShapeField default_field(const RunReader& run, std::size_t snapshot) {
  for (const ShapeField field : {ShapeField::potential, ShapeField::tension}) {
    if (has(run, snapshot, field)) return field;
  }
  return ShapeField::curvature;
}

void require_field(const RunReader& run, std::size_t snapshot, ShapeField field) {
  if (has(run, snapshot, field)) return;
  std::vector<std::string_view> present;
  for (std::size_t i = 0; i < shape_field_names.size(); ++i) {
    if (has(run, snapshot, static_cast<ShapeField>(i))) present.push_back(shape_field_names[i]);
  }
  throw InputError(fmt::format("--field {}: {} has none; accepted: {}",
                               shape_field_names[static_cast<std::size_t>(field)], run.name(),
                               fmt::join(present, ", ")));
}

ShapeCoefficients read_shape(const RunReader& run, std::size_t snapshot, ShapeField field) {
  ShapeCoefficients read{run.times()[snapshot], run.coefficients(snapshot, "x", 3), {}};
  if (const std::string_view dataset = label_of(field).dataset; !dataset.empty()) {
    read.field = run.coefficients(snapshot, std::string(dataset), 1);
  }
  if (field == ShapeField::force) {
    // The whole force of the membrane on the fluid.
    read.field = Matrix::Zero(read.position.rows(), 3);
    for (const auto& [name, sign] : forces) {
      if (run.has_field(snapshot, name)) read.field += sign * run.coefficients(snapshot, name, 3);
    }
  }
  return read;
}

Shape shape_of(const ShapeCoefficients& read, ShapeField field, int grid_order) {
  const Matrix& position = read.position;
  const int order = order_of(position.rows());
  const SphereTransform transform(order, make_grid(std::max(grid_order, order)));
  const Surface surface = make_surface(transform, position);
  const int n_phi = transform.grid().n_phi;
  const Vector3 centre = centroid(surface);
  Shape shape;
  shape.time = read.time;
  shape.mesh.points = with_poles(surface.position, position).rowwise() - centre.transpose();
  shape.mesh.normals = with_mean_poles(surface.normal, n_phi).rowwise().normalized();
  shape.mesh.triangles = closed_triangles(transform.grid());
  shape.values = with_mean_poles(values_of(read, field, transform, surface), n_phi).col(0);
  shape.weights = Vector::Zero(shape.values.size());
  shape.weights.head(surface.n_points()) = surface.quadrature;
  const auto& points = shape.mesh.points;
  shape.gyration = points.transpose() * shape.weights.asDiagonal() * points / shape.weights.sum();
  return shape;
}

}  // namespace vehd

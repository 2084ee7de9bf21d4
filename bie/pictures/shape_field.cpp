#include "bie/pictures/shape_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "bie/geometry/surface.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/surface_mesh.hpp"
#include "bie/support/complex_columns.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Forces that a snapshot may contain, with their signs in f = f_b + f_λ − f_E and the contact force.
constexpr std::array forces = {std::pair{"force_bending", 1.0}, std::pair{"force_tension", 1.0},
                               std::pair{"force_electric", -1.0}, std::pair{"force_contact", 1.0}};

using Values = ShapeField::Values;

bool has(const RunSnapshot& snapshot, const ShapeField& field) {
  if (field.values == Values::force) {
    return std::ranges::any_of(forces, [&](const auto& force) { return snapshot.has_field(force.first); });
  }
  return field.datasets[0].empty() || snapshot.has_field(std::string(field.datasets[0]));
}

Vector values_of(const VesicleCoefficients& read, const ShapeField& field, const SphereTransform& transform,
                 const Surface& surface) {
  switch (field.values) {
    case Values::none:
      break;
    case Values::curvature:
      return surface.mean_curvature;
    case Values::dataset:
      return transform.synthesize(read.field).col(0);
    case Values::force:
    case Values::amplitude:
      return transform.synthesize(read.field).rowwise().norm();
    case Values::phase:
      return phases_deg(transform.synthesize(read.field));
  }
  return Vector::Zero(surface.n_points());
}

/// Values on the grid, then their means over the circles next to the north and the south pole.
Matrix with_mean_poles(const Matrix& values, int n_phi) {
  Matrix result(values.rows() + 2, values.cols());
  result.topRows(values.rows()) = values;
  result.row(values.rows()) = values.topRows(n_phi).colwise().mean();
  result.row(values.rows() + 1) = values.bottomRows(n_phi).colwise().mean();
  return result;
}

}  // namespace

const ShapeField& shape_field(std::string_view name) {
  return *std::ranges::find(shape_fields, name, &ShapeField::name);
}

std::string field_text(const ShapeField& field, const Scene& scene) {
  const bool is_density = field.name == "poration" && scene.poration && scene.poration->model == PorationModel::pores;
  return is_density ? "ln(N/N₀)" : std::string(field.text);
}

const ShapeField& default_field(const RunSnapshot& snapshot) {
  for (const char* name : {"V_m", "V_m_amplitude", "tension"}) {
    if (has(snapshot, shape_field(name))) return shape_field(name);
  }
  return shape_field("curvature");
}

void require_field(const RunSnapshot& snapshot, const ShapeField& field) {
  if (has(snapshot, field)) return;
  std::vector<std::string_view> present;
  for (const ShapeField& other : shape_fields) {
    if (has(snapshot, other)) present.push_back(other.name);
  }
  throw InputError(
      fmt::format("--field {}: {} has none; accepted: {}", field.name, snapshot.name(), fmt::join(present, ", ")));
}

namespace {

VesicleCoefficients read_vesicle(const RunSnapshot& snapshot, const ShapeField& field, std::size_t vesicle) {
  VesicleCoefficients read{snapshot.coefficients("x", 3, vesicle), {}};
  const Index n = read.position.rows();
  for (const std::string_view dataset : field.datasets) {
    if (dataset.empty()) continue;
    read.field.conservativeResize(n, read.field.cols() + 1);
    read.field.rightCols<1>() = snapshot.coefficients(std::string(dataset), 1, vesicle);
  }
  if (field.values == Values::force) {
    // The total force of the membrane on the fluid.
    read.field = Matrix::Zero(n, 3);
    for (const auto& [name, sign] : forces) {
      if (snapshot.has_field(name)) read.field += sign * snapshot.coefficients(name, 3, vesicle);
    }
  }
  return read;
}

/// One vesicle, not shifted.
Shape shape_of(const VesicleCoefficients& read, const ShapeField& field, int grid_order) {
  const Matrix& position = read.position;
  const int order = order_of(position.rows());
  const SphereTransform transform(order, make_grid(std::max(grid_order, order)));
  const Surface surface = make_surface(transform, position);
  const int n_phi = transform.grid().n_phi;
  Shape shape;
  shape.mesh.points = with_poles(surface.position, position);
  shape.mesh.normals = with_mean_poles(surface.normal, n_phi).rowwise().normalized();
  shape.mesh.triangles = closed_triangles(transform.grid());
  shape.values = with_mean_poles(values_of(read, field, transform, surface), n_phi).col(0);
  shape.weights = Vector::Zero(shape.values.size());
  shape.weights.head(surface.n_points()) = surface.quadrature;
  return shape;
}

template <typename Values>
Values stacked(const Values& above, const Values& below) {
  if (above.size() == 0) return below;
  Values all(above.rows() + below.rows(), above.cols());
  all << above, below;
  return all;
}

void append(Shape& shape, const Shape& other) {
  const std::int64_t first = shape.mesh.points.rows();
  for (const std::int64_t point : other.mesh.triangles) shape.mesh.triangles.push_back(first + point);
  shape.mesh.points = stacked(shape.mesh.points, other.mesh.points);
  shape.mesh.normals = stacked(shape.mesh.normals, other.mesh.normals);
  shape.values = stacked(shape.values, other.values);
  shape.weights = stacked(shape.weights, other.weights);
}

}  // namespace

ShapeCoefficients read_shape(const RunSnapshot& snapshot, const ShapeField& field) {
  ShapeCoefficients read{snapshot.time(), {}};
  for (std::size_t a = 0; a < snapshot.n_vesicles(); ++a) read.vesicles.push_back(read_vesicle(snapshot, field, a));
  return read;
}

Shape shape_of(const ShapeCoefficients& read, const ShapeField& field, int grid_order) {
  Shape shape;
  for (const VesicleCoefficients& vesicle : read.vesicles) append(shape, shape_of(vesicle, field, grid_order));
  shape.time = read.time;
  Matrix& points = shape.mesh.points;
  shape.centre = points.transpose() * shape.weights / shape.weights.sum();
  points.rowwise() -= shape.centre.transpose();
  shape.gyration = points.transpose() * shape.weights.asDiagonal() * points / shape.weights.sum();
  return shape;
}

}  // namespace vehd

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

/// Forces that a snapshot may have; the electric one is that on the membrane's charges, which the membrane hands on.
constexpr std::array forces = {std::pair{"force_bending", 1.0}, std::pair{"force_tension", 1.0},
                               std::pair{"force_electric", -1.0}, std::pair{"force_contact", 1.0}};

/// Datasets of the real and of the imaginary part.
std::array<std::string_view, 2> parts_of(ShapeField field) {
  if (field == ShapeField::charge_amplitude) return {"q_real", "q_imaginary"};
  return {"Vm_real", "Vm_imaginary"};
}

bool is_of_amplitude(ShapeField field) {
  return field == ShapeField::potential_amplitude || field == ShapeField::potential_phase ||
         field == ShapeField::charge_amplitude;
}

bool has(const RunSnapshot& snapshot, ShapeField field) {
  switch (field) {
    case ShapeField::potential:
      return snapshot.has_field("Vm");
    case ShapeField::charge:
      return snapshot.has_field("q");
    case ShapeField::tension:
    case ShapeField::poration:
    case ShapeField::conductance:
    case ShapeField::capacitance:
    case ShapeField::pump_current:
    case ShapeField::bending_modulus:
    case ShapeField::spontaneous_curvature:
      return snapshot.has_field(std::string(label_of(field).dataset));
    case ShapeField::potential_amplitude:
    case ShapeField::potential_phase:
    case ShapeField::charge_amplitude:
      return snapshot.has_field(std::string(parts_of(field).front()));
    case ShapeField::force:
      return std::ranges::any_of(forces, [&](const auto& force) { return snapshot.has_field(force.first); });
    case ShapeField::none:
    case ShapeField::curvature:
      break;
  }
  return true;
}

Vector values_of(const VesicleCoefficients& read, ShapeField field, const SphereTransform& transform,
                 const Surface& surface) {
  switch (field) {
    case ShapeField::potential:
    case ShapeField::charge:
    case ShapeField::tension:
    case ShapeField::poration:
    case ShapeField::conductance:
    case ShapeField::capacitance:
    case ShapeField::pump_current:
    case ShapeField::bending_modulus:
    case ShapeField::spontaneous_curvature:
      return transform.synthesize(read.field).col(0);
    case ShapeField::force:
    case ShapeField::potential_amplitude:
    case ShapeField::charge_amplitude:
      return transform.synthesize(read.field).rowwise().norm();
    case ShapeField::potential_phase:
      return phases_deg(transform.synthesize(read.field));
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
    case ShapeField::potential_amplitude:
      return {"|V_m|", "potential"};
    case ShapeField::potential_phase:
      return {"phase of V_m (degrees)", "1"};
    case ShapeField::charge_amplitude:
      return {"|q|", "potential/length"};
    case ShapeField::poration:
      return {"X, or ln(N/N₀)", "1", "poration"};
    case ShapeField::conductance:
      return {"G_m", "conductance/area", "conductance"};
    case ShapeField::capacitance:
      return {"C_m", "capacitance/area", "capacitance"};
    case ShapeField::pump_current:
      return {"J_p", "current/area", "pump_current"};
    case ShapeField::bending_modulus:
      return {"κ_B", "energy", "bending_modulus"};
    case ShapeField::spontaneous_curvature:
      return {"c", "1/length", "spontaneous_curvature"};
    case ShapeField::none:
      break;
  }
  return {"", "1"};
}

ShapeField default_field(const RunSnapshot& snapshot) {
  for (const ShapeField field : {ShapeField::potential, ShapeField::potential_amplitude, ShapeField::tension}) {
    if (has(snapshot, field)) return field;
  }
  return ShapeField::curvature;
}

void require_field(const RunSnapshot& snapshot, ShapeField field) {
  if (has(snapshot, field)) return;
  std::vector<std::string_view> present;
  for (std::size_t i = 0; i < shape_field_names.size(); ++i) {
    if (has(snapshot, static_cast<ShapeField>(i))) present.push_back(shape_field_names[i]);
  }
  throw InputError(fmt::format("--field {}: {} has none; accepted: {}",
                               shape_field_names[static_cast<std::size_t>(field)], snapshot.name(),
                               fmt::join(present, ", ")));
}

namespace {

VesicleCoefficients read_vesicle(const RunSnapshot& snapshot, ShapeField field, std::size_t vesicle) {
  VesicleCoefficients read{snapshot.coefficients("x", 3, vesicle), {}};
  if (const std::string_view dataset = label_of(field).dataset; !dataset.empty()) {
    read.field = snapshot.coefficients(std::string(dataset), 1, vesicle);
  }
  if (is_of_amplitude(field)) {
    const auto [real, imaginary] = parts_of(field);
    read.field.resize(read.position.rows(), 2);
    read.field << snapshot.coefficients(std::string(real), 1, vesicle),
        snapshot.coefficients(std::string(imaginary), 1, vesicle);
  }
  if (field == ShapeField::force) {
    // The whole force of the membrane on the fluid.
    read.field = Matrix::Zero(read.position.rows(), 3);
    for (const auto& [name, sign] : forces) {
      if (snapshot.has_field(name)) read.field += sign * snapshot.coefficients(name, 3, vesicle);
    }
  }
  return read;
}

/// One vesicle where it is.
Shape shape_of(const VesicleCoefficients& read, ShapeField field, int grid_order) {
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

ShapeCoefficients read_shape(const RunSnapshot& snapshot, ShapeField field) {
  ShapeCoefficients read{snapshot.time(), {}};
  for (std::size_t a = 0; a < snapshot.n_vesicles(); ++a) read.vesicles.push_back(read_vesicle(snapshot, field, a));
  return read;
}

Shape shape_of(const ShapeCoefficients& read, ShapeField field, int grid_order) {
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

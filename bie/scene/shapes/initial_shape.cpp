#include "bie/scene/shapes/initial_shape.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "bie/scene/reader.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/shapes/shapes_of_revolution.hpp"
#include "bie/scene/units.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

/// Unit vector of a direction.
Vector3 direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Coefficients of Σ a Re Y_n^m without modes above the degree, which occur in trial runs of a lower one.
Vector sum_of_modes(const std::vector<HarmonicMode>& modes, int degree) {
  Vector coefficients = Vector::Zero(n_coefficients(degree));
  for (const HarmonicMode& mode : modes) {
    if (mode.n > degree) continue;
    // Re and Im of the complex harmonic are 1/√2 of the real ones.
    coefficients[coefficient_index(mode.n, mode.m)] += mode.m == 0 ? mode.a : mode.a / std::numbers::sqrt2;
  }
  return coefficients;
}

/// x = axes · r̂, whose components are the three harmonics of degree 1: exact, with all other coefficients zero.
Matrix ellipsoid_position(const Triple& axes, int order) {
  Matrix position = Matrix::Zero(n_coefficients(order), 3);
  const double unit = std::sqrt(4.0 * std::numbers::pi / 3.0);
  position(coefficient_index(1, 1), 0) = axes[0] * unit;
  position(coefficient_index(1, -1), 1) = axes[1] * unit;
  position(coefficient_index(1, 0), 2) = axes[2] * unit;
  return position;
}

Vector radius_on(const SphereTransform& of_shape, const ShapeScene& shape) {
  // All modes are included, in a trial run of a lower degree as well.
  int degree = of_shape.order();
  for (const HarmonicMode& mode : shape.modes) degree = std::max(degree, mode.n);
  const Vector s = SphereTransform(degree, of_shape.grid()).synthesize(sum_of_modes(shape.modes, degree)).col(0);
  if (!shape.amplitude) return shape.base + s.array();
  return shape.base + *shape.amplitude * (shape.exponent * s.array()).exp();
}

Matrix radial_position(const Scene& scene) {
  const SphereTransform transform = shape_transform(scene.numerics.order);
  const Vector radius = radius_on(transform, scene.shape);
  return without_rounding(position_through(
      transform, [&](Index i, double theta, double phi) -> Vector3 { return radius(i) * direction(theta, phi); }));
}

/// The sphere of the area of a membrane about the origin whose points are nearest to those of the membrane, which may
/// have moved within its shape.
/// Source: the orthogonal Procrustes problem, Schönemann 1966
Matrix nearest_sphere(const Matrix& position) {
  const double radius = std::sqrt(size_of(position).area / (4.0 * std::numbers::pi));
  const Matrix sphere = ellipsoid_position({radius, radius, radius}, order_of(position.rows()));
  const Eigen::JacobiSVD<Matrix3> svd(position.transpose() * sphere, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return sphere * svd.matrixV() * svd.matrixU().transpose();
}

/// x_s + t (x − x_s), x_s the nearest sphere of the same area, with the t that gives the reduced volume v. t is found
/// by the secant method for √(1 − v), which is nearly proportional to t.
/// @return nullopt if there is no such t, or if a ray from the centre would meet the membrane twice
std::optional<Matrix> with_reduced_volume(const Matrix& position, double reduced_volume) {
  constexpr int most_passes = 40;
  constexpr double rounding = 1e-13;  // of v
  Matrix shape = position;
  shape.row(0).setZero();
  const Matrix sphere = nearest_sphere(shape);
  const auto moved = [&](double t) -> Matrix { return sphere + t * (shape - sphere); };
  const auto depth = [&](double t) {
    const ShapeSize size = size_of(moved(t));
    const double v = 6.0 * std::sqrt(std::numbers::pi) * size.volume / std::pow(size.area, 1.5);
    return std::sqrt(std::max(0.0, 1.0 - v));
  };
  const double wanted = std::sqrt(1.0 - reduced_volume);
  double before = 0.0, t = wanted == 0.0 ? 0.0 : 1.0, depth_before = 0.0, now = depth(t);
  for (int pass = 0; std::abs(now * now - wanted * wanted) > rounding; ++pass) {
    const double next = t + (wanted - now) * (t - before) / (now - depth_before);
    if (pass == most_passes || !std::isfinite(next)) return std::nullopt;
    before = std::exchange(t, next);
    depth_before = std::exchange(now, depth(t));
  }
  const SphereTransform transform = shape_transform(order_of(position.rows()));
  const Vector outwards = transform.synthesize(moved(t)).cwiseProduct(transform.synthesize(sphere)).rowwise().sum();
  if (!(outwards.minCoeff() > 0.0)) return std::nullopt;
  Matrix result = without_rounding(moved(t));
  result.row(0) = position.row(0);
  return result;
}

bool is_moved(const ShapeScene& shape) { return shape.reduced_volume && !has_unit_size(shape.kind); }

/// Factor from numbers of a shape file to those of the scene, 1 if either lacks the scale. check_scene refuses a scene
/// that needs the scale.
double factor_from(const RunReader& run, const Scene& scene, std::optional<double> UnitsScene::*scale) {
  return conversion(units_of(run), scene.units, scale).value_or(1.0);
}

InitialMembrane unplaced_membrane(const Scene& scene) {
  const ShapeScene& shape = scene.shape;
  const int order = scene.numerics.order;
  const double v = shape.reduced_volume.value_or(1.0);
  if (shape.kind == ShapeKind::ellipsoid) return {ellipsoid_position(shape.axes, order), {}};
  if (shape.kind == ShapeKind::prolate) return {ellipsoid_position(prolate_axes(v), order), {}};
  if (shape.kind == ShapeKind::oblate) return {ellipsoid_position(oblate_axes(v), order), {}};
  if (shape.kind == ShapeKind::biconcave) return {biconcave_position(v, order), {}};
  if (shape.kind == ShapeKind::stomatocyte) return {stomatocyte_position(v, order), {}};
  if (shape.kind == ShapeKind::radial) return {radial_position(scene), {}};
  const RunReader run(shape.path);
  const RunSnapshot start = start_snapshot(run, scene);
  const Matrix position = factor_from(run, scene, &UnitsScene::length) * start.coefficients("x", 3);
  InitialMembrane membrane{resize_order(position, order), {}};
  if (takes_stored_potential(scene)) {
    const Vector potential = factor_from(run, scene, &UnitsScene::potential) * start.coefficients("Vm", 1).col(0);
    membrane.potential = resize_order(potential, order);
  }
  return membrane;
}

double size_factor(const ShapeScene& shape, const Matrix& position) {
  if (shape.scale) return *shape.scale;
  if (!shape.area) return 1.0;
  return std::sqrt(*shape.area / (has_unit_size(shape.kind) ? 4.0 * std::numbers::pi : size_of(position).area));
}

/// Transform between a degree and a grid for sampling a cap, whose spectrum falls like a Gaussian.
SphereTransform cap_transform(int order) { return {order, make_grid(2 * order + 32)}; }

Vector cap_values(const VaryingProperty& varying, const SphereGrid& grid) {
  constexpr double degree = std::numbers::pi / 180.0;
  const Vector3 axis = vector_of(varying.axis).stableNormalized();
  const double edge = std::cos(varying.angle_deg * degree);
  const double width = varying.width_deg * degree * std::sin(varying.angle_deg * degree);
  Vector values(grid.n_points());
  for (Index i = 0; i < values.size(); ++i) {
    const Vector3 r = direction(grid.theta[i / grid.n_phi], grid.phi[i % grid.n_phi]);
    const double share = 0.5 * std::erfc((edge - axis.dot(r)) / width);
    values[i] = varying.outside + (varying.inside - varying.outside) * share;
  }
  return values;
}

}  // namespace

InitialMembrane initial_membrane(const Scene& scene) {
  const ShapeScene& shape = scene.shape;
  InitialMembrane membrane = unplaced_membrane(scene);
  if (is_moved(shape)) {
    if (auto moved = with_reduced_volume(membrane.position, *shape.reduced_volume)) membrane.position = *moved;
  }
  membrane.position *= size_factor(shape, membrane.position);
  if (shape.rotation) {
    const Matrix3 rotation = rotation_matrix(*shape.rotation);
    membrane.position = rotated(membrane.position, rotation);
    if (membrane.potential.size() > 0) membrane.potential = rotated_scalar(membrane.potential, rotation);
  }
  membrane.position = shifted(std::move(membrane.position), shape.centre);
  return membrane;
}

bool has_unit_size(ShapeKind kind) {
  return kind != ShapeKind::ellipsoid && kind != ShapeKind::radial && kind != ShapeKind::file;
}

bool has_reduced_volume(const Scene& scene) {
  return !is_moved(scene.shape) ||
         with_reduced_volume(unplaced_membrane(scene).position, *scene.shape.reduced_volume).has_value();
}

RunSnapshot start_snapshot(const RunReader& run, const Scene& scene) {
  if (!scene.shape.time) return run.snapshot(run.times().size() - 1);
  return run.snapshot(run.at(*scene.shape.time / factor_from(run, scene, &UnitsScene::time)));
}

bool fix_snapshot(Scene& scene, const RunReader& run) {
  const RunSnapshot snapshot = start_snapshot(run, scene);
  ShapeScene& shape = scene.shape;
  const auto factor = conversion(units_of(run), scene.units, &UnitsScene::time);
  if (!shape.time && factor) shape.time = *factor * snapshot.time();
  if (!shape.checksum) shape.checksum = snapshot.checksum();
  return shape.checksum == snapshot.checksum();
}

Matrix initial_position(const Scene& scene) { return initial_membrane(scene).position; }

Extremes radius_extremes(const Scene& scene) {
  const Vector radius = radius_on(shape_transform(scene.numerics.order), scene.shape);
  // minCoeff would skip a NaN.
  if (radius.allFinite()) return {radius.minCoeff(), radius.maxCoeff()};
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {none, none};
}

Vector varying_factor(const VaryingProperty& varying, int order) {
  if (varying.kind != VariationKind::cap) {
    Vector factor = sum_of_modes(varying.modes, order);
    factor[0] += varying.base * coefficient_of_one;
    return factor;
  }
  const SphereTransform transform = cap_transform(order);
  return without_rounding(transform.analyze(cap_values(varying, transform.grid()))).col(0);
}

double varying_factor_truncation(const VaryingProperty& varying, int order) {
  const double difference = std::abs(varying.inside - varying.outside);
  if (varying.kind != VariationKind::cap || difference == 0.0) return 0.0;
  const SphereTransform transform = cap_transform(order);
  const Vector kept = transform.synthesize(varying_factor(varying, order));
  return (kept - cap_values(varying, transform.grid())).cwiseAbs().maxCoeff() / difference;
}

MembraneMaterial initial_material(const Scene& scene) {
  const MembraneScene& membrane = scene.membrane;
  MembraneMaterial material;
  const auto take = [&](const std::optional<VaryingProperty>& varying, double value, Vector& property) {
    if (varying) property = value * varying_factor(*varying, scene.numerics.order);
  };
  if (scene.electric) {
    take(membrane.varying_capacitance, membrane.capacitance, material.capacitance);
    take(membrane.varying_conductance, membrane.conductance, material.conductance);
    if (membrane.pump) take(*membrane.pump, membrane.pump->current, material.pump_current);
  }
  if (membrane.varying_bending || membrane.varying_curvature) {
    // The force needs both properties.
    const VaryingProperty same{};
    take(membrane.varying_bending.value_or(same), membrane.bending_modulus.value_or(0.0), material.bending_modulus);
    take(membrane.varying_curvature.value_or(same), membrane.spontaneous_curvature, material.spontaneous_curvature);
  }
  if (scene.shape.rotation) {
    const Matrix3 rotation = rotation_matrix(*scene.shape.rotation);
    for_each_property(material, [&](Vector& property) { property = rotated_scalar(property, rotation); });
  }
  return material;
}

}  // namespace vehd

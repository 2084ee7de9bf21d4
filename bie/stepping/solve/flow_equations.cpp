#include "bie/stepping/solve/flow_equations.hpp"

#include <algorithm>
#include <utility>

#include "bie/geometry/surface.hpp"
#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/tension.hpp"
#include "bie/physics/effects/undulations.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/solve/sphere_spectrum.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {

namespace {

/// Weight of strain relative to the change of curvature in the norm of the joint system: the ratio of their tolerances
/// (NumericalSettings). Measured.
constexpr double strain_share = 0.1;

}  // namespace

bool uniform_tension_is_free(const FlowParameters& parameters, const Membrane& membrane) {
  return parameters.inextensible && !parameters.undulations &&
         distance_variation(membrane.surface) < thresholds::sphere_variation * membrane.radius;
}

namespace {

/// c and u·n are expanded on the parameter sphere, so on points that have flowed degrees from 2 on have a part of
/// degree 1 in space. Without the mean they contain no translation and exert no net force.
Matrix without_net(const Membrane& membrane, const Matrix& values) {
  return values.rowwise() - surface_mean(membrane.surface, values).transpose();
}

double mean_response(const FlowMembrane& one) {
  return uniform_tension_response(one.membrane.radius, one.parameters.viscosity, one.parameters.viscosity_ratio);
}

}  // namespace

FlowEquations::FlowEquations(const FlowMembrane& one, FlowOptions options) : one_(one), options_(std::move(options)) {
  if (options_.entries.empty()) options_.entries = membrane().subspace.scalars();
  const double radius = membrane().radius;
  tension_scale_ = radius;
  if (bends()) {
    shape_scale_ = 1.0 / radius;
    tension_scale_ = strain_share * (one_.parameters.viscosity * radius / options_.dt +
                                     one_.parameters.bending->modulus / (radius * radius));
  }
  if (has_tension() && one_.parameters.undulations) {
    const Vector area_element = membrane().weighted(Vector::Ones(membrane().surface.n_points()));
    of_dilation_ = Vector::Zero(n());
    for (Index i = 0; i < n(); ++i) {
      const Index entry = options_.entries[static_cast<std::size_t>(i)];
      if (is_tension(entry)) of_dilation_[i] = -area_element[entry] / (one_.parameters.viscosity * radius);
    }
  }
  find_sphere_inverse();
}

/// Does the entry belong to h, or to c? Other entries are zero.
bool FlowEquations::is_shape(Index entry) const {
  if (bends()) return entry < n_coefficients(curvature_transform().order());
  return degree_of(entry) >= 2 && degree_of(entry) < membrane().fine.order();
}

/// Maps both sides of one degree on a sphere to the unknowns (shape, λ).
Eigen::Matrix2d FlowEquations::sphere_inverse(int degree) const {
  const Vector& area = membrane().surface.quadrature;
  const Vector& held = options_.held_tension;
  const SphereFlow sphere{
      membrane().radius, one_.parameters.viscosity,       bends() ? one_.parameters.bending->modulus : 0.0,
      options_.dt,       one_.parameters.viscosity_ratio, held.size() > 0 ? held.dot(area) / area.sum() : 0.0};
  if (degree > membrane().fine.order()) {
    return Eigen::DiagonalMatrix<double, 2>(1.0 / unresolved_curvature(sphere, degree), tension_scale_);
  }
  const bool holds = !bends() && has_shape() && is_shape(coefficient_index(degree, 0));
  Eigen::Matrix2d result = holds ? rigid_sphere_block(sphere, degree) : sphere_flow_block(sphere, degree);
  // A uniform tension exerts no force on a sphere; away from it the response is weak but not zero.
  if (degree == 0) result(1, 1) = area_is_free() ? of_dilation_[0] : mean_response(one_);
  if (!bends() && !holds) result = Eigen::DiagonalMatrix<double, 2>(1.0, result(1, 1));
  if (!has_tension()) result = Eigen::DiagonalMatrix<double, 2>(result(0, 0), 1.0);
  return result.inverse();
}

void FlowEquations::find_sphere_inverse() {
  std::vector<Eigen::Matrix2d> inverse;
  for (int degree = 0; degree <= degree_of(options_.entries.back()); ++degree) {
    inverse.push_back(sphere_inverse(degree));
  }
  inverse_.resize(n(), 4);
  for (Index i = 0; i < n(); ++i) {
    const Eigen::Matrix2d& m = inverse[static_cast<std::size_t>(degree_of(options_.entries[i]))];
    inverse_.row(i) << m.row(0) / shape_scale_, m.row(1) / tension_scale_;
  }
}

void FlowEquations::find_inverse(const TensionGrid& grid) {
  if (options_.is_sphere || has_shape() || !has_tension() || area_is_free()) return;
  of_membrane_.emplace(one_, grid, options_.entries, mean_response(one_));
}

/// The first `count` coefficients of a scalar with these entries; all others are zero.
Vector FlowEquations::spread(const Eigen::Ref<const Vector>& of_entries, Index count) const {
  Vector scalar = Vector::Zero(std::max(count, options_.entries.back() + 1));
  scalar(options_.entries) = of_entries;
  return scalar.head(count);
}

/// Sets the mean by changing the uniform part.
void FlowEquations::with_mean(double mean, Vector& tension) const {
  tension[0] = 0.0;
  tension[0] = coefficient_of_one * (mean - mean_tension(membrane().fine, membrane().surface, tension));
}

FlowScalars FlowEquations::unknowns(const Vector& v) const {
  const Index n_resolved = n_coefficients(membrane().fine.order());
  FlowScalars result;
  if (has_shape()) {
    result.shape =
        spread(shape_scale_ * v.head(n()), bends() ? n_coefficients(curvature_transform().order()) : n_resolved);
  }
  if (has_tension()) result.tension = spread(tension_scale_ * v.tail(n()), n_resolved);
  if (area_is_free()) with_mean(0.0, result.tension);
  return result;
}

Vector FlowEquations::over_scales(const FlowScalars& unknowns) const {
  Vector result = rows(unknowns);
  result.head(n_shape()) /= shape_scale_;
  result.tail(n_tension()) /= tension_scale_;
  return result;
}

FlowScalars FlowEquations::guess(const Vector& tension) const {
  FlowScalars result = unknowns(Vector::Zero(size()));
  if (!has_tension()) return result;
  if (tension.size() > 0) result.tension = spread(tension(options_.entries), result.tension.size());
  if (options_.is_sphere) result.tension[0] = 0.0;
  if (area_is_free()) {
    with_mean(AreaLaw(*one_.parameters.undulations).tension(surface_area(membrane().surface)), result.tension);
  }
  return result;
}

Vector FlowEquations::without_mean(Vector unknowns) const {
  if (has_tension()) unknowns[n_shape()] = 0.0;
  return unknowns;
}

Matrix FlowEquations::force(const FlowScalars& unknowns) const {
  if (unknowns.shape.size() == 0 && unknowns.tension.size() == 0) return {};
  const Surface& s = membrane().surface;
  Matrix force = Matrix::Zero(s.n_points(), 3);
  if (unknowns.shape.size() > 0 && bends()) {
    const Index n_resolved = n_coefficients(membrane().fine.order());
    force += linearised_bending_force(*one_.parameters.bending, membrane(), unknowns.shape.head(n_resolved));
    if (options_.held_tension.size() > 0) {
      const Vector increment = curvature_transform().synthesize(unknowns.shape).col(0);
      force += 2.0 * options_.held_tension.cwiseProduct(increment).asDiagonal() * s.normal;
    }
  } else if (unknowns.shape.size() > 0) {
    const Matrix normal = Vector(membrane().fine.synthesize(unknowns.shape)).asDiagonal() * s.normal;
    force += without_net(membrane(), normal);
  }
  if (unknowns.tension.size() > 0) force += tension_force(membrane(), unknowns.tension);
  return force;
}

Vector FlowEquations::left_side(const Matrix& velocity, const Vector& v) const {
  if (size() == 0) return {};
  const SphereTransform& fine = membrane().fine;
  const SphereDerivatives u =
      bends() ? fine.synthesize_derivatives(velocity) : fine.synthesize_first_derivatives(velocity);
  FlowScalars sides;
  if (bends()) {
    const Vector h = unknowns(v).shape;
    sides.shape = h - options_.dt * curvature_increment(membrane(), curvature_transform(), u);
  } else if (has_shape()) {
    const Matrix moving = without_net(membrane(), fine.synthesize(velocity));
    sides.shape = fine.analyze(moving.cwiseProduct(membrane().surface.normal).rowwise().sum());
  }
  if (has_tension()) sides.tension = weighted_divergence(membrane(), u);
  Vector result = rows(sides);
  if (area_is_free()) result.tail(n()) += tension_scale_ * v[n_shape()] * of_dilation_;
  // Entries that must be zero have equations that keep them zero.
  for (Index i = 0; i < n(); ++i) {
    const Index entry = options_.entries[static_cast<std::size_t>(i)];
    if (has_shape() && !is_shape(entry)) result[i] = shape_scale_ * v[i];
    if (has_tension() && !is_tension(entry)) result[n_shape() + i] = v[n_shape() + i];
  }
  if (options_.is_sphere) result[n_shape()] = mean_response(one_) * tension_scale_ * v[n_shape()];
  return result;
}

Vector FlowEquations::rows(const FlowScalars& right_side) const {
  Vector result = Vector::Zero(size());
  for (Index i = 0; i < n(); ++i) {
    const Index entry = options_.entries[static_cast<std::size_t>(i)];
    if (has_shape() && is_shape(entry)) result[i] = right_side.shape[entry];
    if (has_tension() && is_tension(entry)) result[n_shape() + i] = right_side.tension[entry];
  }
  return result;
}

Vector FlowEquations::approximate_inverse(const Vector& r) const {
  if (of_membrane_) return of_membrane_->apply(r) / tension_scale_;
  if (!has_shape()) return has_tension() ? Vector(inverse_.col(3).cwiseProduct(r)) : Vector();
  if (!has_tension()) return inverse_.col(0).cwiseProduct(r);
  Vector result(2 * n());
  result.head(n()) = inverse_.col(0).cwiseProduct(r.head(n())) + inverse_.col(1).cwiseProduct(r.tail(n()));
  result.tail(n()) = inverse_.col(2).cwiseProduct(r.head(n())) + inverse_.col(3).cwiseProduct(r.tail(n()));
  return result;
}

Vector FlowEquations::image(const ImageOfFields& image, const Vector& rows) const {
  const Index n_scalars = n() > 0 ? rows.size() / n() : 0;
  Vector result(rows.size());
  for (Index j = 0; j < n_scalars; ++j) {
    const Vector all = spread(rows.segment(j * n(), n()), n_coefficients(membrane().fine.order()));
    result.segment(j * n(), n()) = Matrix(image.scalar(all)).col(0)(options_.entries);
  }
  return result;
}

RecycledSubspace FlowEquations::in_system(const RecycledSubspace& recycled) const {
  RecycledSubspace result = recycled;
  result.arguments.topRows(n_shape()) /= shape_scale_;
  result.arguments.bottomRows(n_tension()) /= tension_scale_;
  if (bends()) {
    auto curvature = result.responses.topRows(n());
    curvature = recycled.arguments.topRows(n()) - options_.dt * curvature;
  }
  return result;
}

RecycledSubspace FlowEquations::in_scalars(const RecycledSubspace& recycled) const {
  // A block of a matrix without columns would begin at an offset from a null pointer.
  if (recycled.count() == 0) return recycled;
  RecycledSubspace result = recycled;
  result.arguments.topRows(n_shape()) *= shape_scale_;
  result.arguments.bottomRows(n_tension()) *= tension_scale_;
  if (bends()) {
    auto curvature = result.responses.topRows(n());
    curvature = (result.arguments.topRows(n()) - curvature) / options_.dt;
  }
  return result;
}

}  // namespace vehd

#include "bie/stepping/space/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/averaged_field.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Errors of V_m, tension and q are relative to their largest value, or to this share of |E|R, κ_B/R² and η|E| if that
/// is larger: a small V_m at the start of charging need not be accurate to all its digits.
constexpr double least_share_of_scale = 0.1;
/// Slowest decay from degree to degree in the extrapolation of a spectrum as a geometric series: slower spectra do not
/// decay within the degrees in use (0.97 to the power 64 is a seventh).
constexpr double slowest_decay = 0.97;

/// Bound of each degree n of a field: max |f_n| ≤ |coefficients of degree n| √((2n+1)/4π), by the addition theorem.
/// @param coefficients  [n_coefficients x F]; of vectors the norm is bounded
Vector degree_bounds(const Matrix& coefficients) {
  const int order = order_of(coefficients.rows());
  Vector bounds(order + 1);
  for (int n = 0; n <= order; ++n) {
    const double norm = coefficients.middleRows(coefficient_index(n, -n), 2 * n + 1).norm();
    bounds[n] = norm * std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi));
  }
  return bounds;
}

/// The part of the degrees above `middle`.
Matrix upper_part(Matrix coefficients, int middle) {
  coefficients.topRows(n_coefficients(middle)).setZero();
  return coefficients;
}

double share_of(double largest, const Matrix& upper) {
  const double most = degree_bounds(upper).sum();
  return most > 0.0 ? std::min(1.0, largest / most) : 1.0;
}

}  // namespace

VisibleShare visible_share(const SphereTransform& fine, const SurfaceFields& membrane) {
  const int middle = order_of(membrane.position.rows()) / 2;
  const Matrix upper = upper_part(membrane.position, middle);
  const SphereDerivatives x = fine.synthesize_gradient(membrane.position);
  const Matrix moved = fine.synthesize(upper);
  const bool is_charged = membrane.transmembrane_potential.size() > 0;
  SphereDerivatives v;
  Matrix upper_v, charged;
  if (is_charged) {
    v = fine.synthesize_gradient(membrane.transmembrane_potential);
    upper_v = upper_part(membrane.transmembrane_potential, middle);
    charged = fine.synthesize(upper_v);
  }
  double across = 0.0, at_place = 0.0;
  for (Index i = 0; i < moved.rows(); ++i) {
    const Vector3 d1 = x.d1.row(i), d2 = x.d2.row(i), by = moved.row(i);
    const Vector3 normal = d1.cross(d2);
    across = std::max(across, std::abs(normal.dot(by)) / normal.norm());
    if (!is_charged) continue;
    // by = c₁ x_1 + c₂ x_2 along the surface.
    const double c1 = by.cross(d2).dot(normal) / normal.squaredNorm();
    const double c2 = d1.cross(by).dot(normal) / normal.squaredNorm();
    at_place = std::max(at_place, std::abs(charged(i, 0) - c1 * v.d1(i, 0) - c2 * v.d2(i, 0)));
  }
  VisibleShare share;
  share.shape = share_of(across, upper);
  if (is_charged) share.potential = share_of(at_place, upper_v);
  return share;
}

namespace {

double least_potential_scale(const AppliedField& electric, double radius) {
  return least_share_of_scale * electric.field.norm() * radius;
}

double scale_of(double least, double largest) {
  const double scale = std::max(largest, least);
  // If both are zero, so is the error, and any scale will do.
  return scale > 0.0 ? scale : 1.0;
}

}  // namespace

double potential_scale(const AppliedField& electric, double radius, double largest) {
  return scale_of(least_potential_scale(electric, radius), largest);
}

double charge_scale(const Model& model, std::size_t vesicle, double largest) {
  const ElectricParameters electric = electric_parameters(model, model.vesicles[vesicle]);
  const double contrast = electric.averaged_frequency ? std::abs(complex_conductivities(electric).contrast())
                                                      : std::abs(conductivity_contrast(electric));
  return scale_of(least_share_of_scale * contrast * electric.field.norm(), largest);
}

double tension_scale(const Model& model, std::size_t vesicle, double largest) {
  const std::optional<BendingParameters>& bending = model.vesicles[vesicle].bending;
  // κ_B/R² over the area 4π R².
  return scale_of(bending ? least_share_of_scale * 4.0 * std::numbers::pi * bending->modulus : 0.0, largest);
}

Resolution::Resolution(const Model& model, const VesicleState& vesicle, VisibleShare share)
    : Resolution(model, vesicle, vesicle.transmembrane_potential, share) {}

Resolution::Resolution(const Model& model, const VesicleState& vesicle, const Matrix& potential, VisibleShare share)
    : potential_share_(share.potential) {
  const double radius = vesicle.radius();
  shape_ = share.shape * degree_bounds(vesicle.position) / radius;
  shape_[0] = 0.0;  // position of the vesicle
  for_each_property(vesicle.material, [&](const Vector& property) {
    const Vector bounds = degree_bounds(property);
    if (const double size = bounds.maxCoeff(); size > 0.0) shape_ = shape_.cwiseMax(bounds / size);
  });
  if (!model.electric || potential.size() == 0) return;
  potential_ = degree_bounds(potential);
  least_scale_ = least_potential_scale(*model.electric, radius);
}

Resolution::Tail Resolution::tail_of_cut(int order) const {
  Tail tail{shape_.head(order + 1)};
  Vector& bound = tail.bound;
  if (potential_.size() > 0) {
    const Vector potential = potential_.head(order + 1);
    bound = bound.cwiseMax(potential_share_ * potential / scale_of(least_scale_, potential.maxCoeff()));
  }
  // Symmetry can make every other degree vanish.
  for (Index n = order - 1; n >= 0; --n) bound[n] = std::max(bound[n], bound[n + 1]);
  constexpr double kFloor = 1e-16;
  // The last but one now bounds the last as well, whichever of them vanishes.
  const int middle = order / 2;
  const int end = std::max(middle + 1, order - 1);
  const double ratio = std::max(bound[end], kFloor) / std::max(bound[middle], kFloor);
  tail.decay = std::min(slowest_decay, std::pow(ratio, 1.0 / (end - middle)));
  return tail;
}

/// Sum of the geometric series above degree `order`, which is at least the last of the spectrum.
double Resolution::Tail::beyond(int order) const {
  const int last = static_cast<int>(bound.size()) - 1;
  return bound[std::max(0, last - 1)] * decay / (1.0 - decay) * std::pow(decay, order - last);
}

double Resolution::remainder_at(int order) const {
  const Tail whole = tail_of_cut(last());
  if (order >= last()) return whole.beyond(order);
  const double left_out = whole.beyond(last()) + whole.bound.tail(last() - order).sum();
  return std::max(left_out, tail_of_cut(order).beyond(order));
}

double Resolution::remainder() const { return remainder_at(last()); }

int Resolution::order_for(double target, int lowest, int highest) const {
  int order = lowest + lowest % 2;
  while (order < highest && remainder_at(order) > target) order += 2;
  return std::min(order, highest);
}

}  // namespace vehd

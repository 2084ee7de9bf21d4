#include "bie/stepping/space/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/averaged_field.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/degree_bounds.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {

namespace {

double least_potential_scale(const AppliedField& electric, double radius) {
  return thresholds::least_size * electric.field.norm() * radius;
}

double scale_of(double least, double largest) {
  const double scale = std::max(largest, least);
  // Where both are zero any scale serves: the error is zero.
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
  return scale_of(thresholds::least_size * contrast * electric.field.norm(), largest);
}

double tension_scale(const Model& model, std::size_t vesicle, double largest) {
  const std::optional<BendingParameters>& bending = model.vesicles[vesicle].bending;
  // κ_B/R² over the area 4π R².
  return scale_of(bending ? thresholds::least_size * 4.0 * std::numbers::pi * bending->modulus : 0.0, largest);
}

Resolution::Resolution(const Model& model, const VesicleState& vesicle, VisibleShare share)
    : Resolution(model, vesicle, vesicle.transmembrane_potential, share) {}

Resolution::Resolution(const Model& model, const VesicleState& vesicle, const Matrix& potential, VisibleShare share)
    : potential_share_(share.potential) {
  const double radius = std::sqrt(vesicle.reference_area / (4.0 * std::numbers::pi));
  shape_ = share.shape * degree_bounds(vesicle.position) / radius;
  shape_[0] = 0.0;  // where the vesicle is
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
  // Symmetry can silence every other degree.
  for (Index n = order - 1; n >= 0; --n) bound[n] = std::max(bound[n], bound[n + 1]);
  constexpr double kFloor = 1e-16;
  // The last but one holds the last as well, whichever of them is silent.
  const int middle = order / 2;
  const int end = std::max(middle + 1, order - 1);
  const double ratio = std::max(bound[end], kFloor) / std::max(bound[middle], kFloor);
  tail.decay = std::min(thresholds::slowest_decay, std::pow(ratio, 1.0 / (end - middle)));
  return tail;
}

/// Sum of the geometric series from degree `order` + 1 on, where that is at least the last of the spectrum.
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

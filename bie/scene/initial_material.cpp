#include "bie/scene/initial_material.hpp"

#include <cmath>
#include <numbers>

#include "bie/scene/placement.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {
namespace {

/// Between a degree and a grid on which a cap is sampled, whose spectrum falls like a Gaussian.
SphereTransform cap_transform(int order) { return {order, make_grid(2 * order + 32)}; }

Vector cap_values(const PlaceScene& places, const SphereGrid& grid) {
  constexpr double degree = std::numbers::pi / 180.0;
  const Vector3 axis = Vector3(places.axis[0], places.axis[1], places.axis[2]).stableNormalized();
  const double edge = std::cos(places.angle_deg * degree);
  const double width = places.width_deg * degree * std::sin(places.angle_deg * degree);
  Vector values(grid.n_points());
  for (Index i = 0; i < values.size(); ++i) {
    const double theta = grid.theta[i / grid.n_phi], phi = grid.phi[i % grid.n_phi];
    const Vector3 r(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    const double share = 0.5 * std::erfc((edge - axis.dot(r)) / width);
    values[i] = places.outside + (places.inside - places.outside) * share;
  }
  return values;
}

Vector sum_of_modes(const PlaceScene& places, int order) {
  Vector factor = Vector::Zero(n_coefficients(order));
  factor[0] = places.base * std::sqrt(4.0 * std::numbers::pi);
  for (const HarmonicMode& mode : places.modes) {
    // Trial runs may have a lower degree than the modes.
    if (mode.n > order) continue;
    // Re and Im of the complex harmonic are 1/√2 of the real ones.
    factor[coefficient_index(mode.n, mode.m)] += mode.m == 0 ? mode.a : mode.a / std::numbers::sqrt2;
  }
  return factor;
}

}  // namespace

Vector place_factor(const PlaceScene& places, int order) {
  if (places.kind != PlaceKind::cap) return sum_of_modes(places, order);
  const SphereTransform transform = cap_transform(order);
  return without_rounding(transform.analyze(cap_values(places, transform.grid()))).col(0);
}

double place_truncation(const PlaceScene& places, int order) {
  const double difference = std::abs(places.inside - places.outside);
  if (places.kind != PlaceKind::cap || difference == 0.0) return 0.0;
  const SphereTransform transform = cap_transform(order);
  const Vector kept = transform.synthesize(place_factor(places, order));
  return (kept - cap_values(places, transform.grid())).cwiseAbs().maxCoeff() / difference;
}

MembraneMaterial initial_material(const Scene& scene) {
  const MembraneScene& membrane = scene.membrane;
  const int order = scene.numerics.order;
  MembraneMaterial material;
  const auto take = [&](const std::optional<PlaceScene>& places, double value, Vector& property) {
    if (places) property = value * place_factor(*places, order);
  };
  if (scene.electric) {
    take(membrane.capacitance_by_place, membrane.capacitance, material.capacitance);
    take(membrane.conductance_by_place, membrane.conductance, material.conductance);
    if (membrane.pump) take(*membrane.pump, membrane.pump->current, material.pump_current);
  }
  if (membrane.bending_by_place || membrane.curvature_by_place) {
    // The force needs both.
    const PlaceScene same{};
    take(membrane.bending_by_place.value_or(same), membrane.bending_modulus.value_or(0.0), material.bending_modulus);
    take(membrane.curvature_by_place.value_or(same), membrane.spontaneous_curvature, material.spontaneous_curvature);
  }
  if (scene.shape.rotation) {
    const Matrix3 rotation = rotation_matrix(*scene.shape.rotation);
    for_each_property(material, [&](Vector& property) { property = rotated_scalar(property, rotation); });
  }
  return material;
}

}  // namespace vehd

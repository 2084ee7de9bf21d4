#include "bie/physics/effects/tension.hpp"

#include "bie/physics/model.hpp"

namespace vehd {

namespace {

constexpr const char* kInextensibility = "inextensibility";

}  // namespace

Matrix tension_force(const Membrane& membrane, const Vector& tension) {
  const Surface& s = membrane.surface;
  const SphereDerivatives lambda = membrane.fine.synthesize_gradient(tension);
  const Vector normal_part = 2.0 * s.mean_curvature.cwiseProduct(lambda.value.col(0));
  return surface_gradient(s, lambda) + normal_part.asDiagonal() * s.normal;
}

Vector weighted_divergence(const Membrane& membrane, const SphereDerivatives& velocity) {
  return membrane.weighted(surface_divergence(membrane.surface, velocity));
}

double mean_tension(const SphereTransform& fine, const Surface& surface, const Vector& tension) {
  return surface.quadrature.dot(fine.synthesize(tension).col(0)) / surface_area(surface);
}

double dilation(const Membrane& membrane, const Matrix& velocity) {
  const Surface& s = membrane.surface;
  const Vector divergence = surface_divergence(s, membrane.fine.synthesize_first_derivatives(velocity));
  return s.quadrature.dot(divergence) / surface_area(s);
}

EffectRow tension_row() {
  return {kInextensibility,
          [](const Model& model, const VesicleModel& vesicle) -> MadeEffect {
            if (!model.mobile || !vesicle.inextensible) return nullptr;
            return described([] {
              return EffectDescription{kInextensibility,
                                       "f_lambda, Eq. (2), from div_gamma v = 0, Eq. (27b)",
                                       {{&LayerSelection::stokes_single, "velocity of f_lambda, Eq. (5)"}},
                                       {"tension"}};
            });
          },
          [](Model&, VesicleModel& vesicle) { vesicle.inextensible = false; }};
}

}  // namespace vehd

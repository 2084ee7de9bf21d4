#include "bie/physics/effects/bending.hpp"

#include "bie/physics/model.hpp"

namespace vehd {

namespace {

constexpr const char* kBending = "bending";

/// −κ_B (Δ_γ h + 2h(H² − K)) n, Eqs. (2) and (28a), from the Hessian of h.
Matrix force_of_curvature(const BendingParameters& bending, const Surface& s, const SphereDerivatives& h) {
  const Eigen::ArrayXd laplacian = surface_laplacian(s, h).col(0).array();
  const Eigen::ArrayXd deviator = s.mean_curvature.array().square() - s.gauss_curvature.array();
  const Vector magnitude = -bending.modulus * (laplacian + 2.0 * h.value.col(0).array() * deviator);
  return magnitude.asDiagonal() * s.normal;
}

}  // namespace

Matrix bending_force(const BendingParameters& bending, const Membrane& membrane) {
  // Degrees above p alias under the Laplacian and no implicit term of degree p would damp them: at large κ_B dt the
  // untruncated curvature makes an equilibrium unstable.
  const Vector curvature = membrane.fine.analyze(membrane.surface.mean_curvature);
  return linearised_bending_force(bending, membrane, curvature);
}

double bending_energy_scaled(const Surface& surface) {
  return surface.mean_curvature.array().square().matrix().dot(surface.quadrature);
}

Vector curvature_increment(const Membrane& membrane, const SphereTransform& to, const SphereDerivatives& displacement) {
  const Surface& s = membrane.surface;
  const SphereDerivatives& x = displacement;
  Vector h(s.n_points());
#pragma omp simd
  for (Index i = 0; i < h.size(); ++i) {
    double bent = 0.0, stretched = 0.0;
    for (Index c = 0; c < 3; ++c) {
      // Δ_γ as in surface_laplacian.
      const double laplacian = s.g11[i] * x.d11(i, c) + 2.0 * (s.g12[i] * x.d12(i, c)) + s.g22[i] * x.d22(i, c) -
                               s.laplace_1[i] * x.d1(i, c) - s.laplace_2[i] * x.d2(i, c);
      bent += laplacian * s.normal(i, c);
      const double x1 = s.tangent_1(i, c), x2 = s.tangent_2(i, c);
      stretched +=
          s.b11[i] * x1 * x.d1(i, c) + s.b12[i] * (x1 * x.d2(i, c) + x2 * x.d1(i, c)) + s.b22[i] * x2 * x.d2(i, c);
    }
    h[i] = 0.5 * bent - stretched;
  }
  return to.analyze(h);
}

Matrix linearised_bending_force(const BendingParameters& bending, const Membrane& membrane, const Vector& increment) {
  if (has_varying_bending(membrane)) {
    const Vector& modulus = membrane.material.bending_modulus;
    const Vector moment = modulus.cwiseProduct(Vector(membrane.fine.synthesize(increment)));
    return force_of_curvature({1.0}, membrane.surface, membrane.fine.synthesize_hessian(membrane.fine.analyze(moment)));
  }
  return force_of_curvature(bending, membrane.surface, membrane.fine.synthesize_hessian(increment));
}

namespace {

/// ∇_γ f from values of f on the upsampled grid, [n_points x 3].
Matrix gradient_of(const Membrane& membrane, const Vector& values) {
  return surface_gradient(membrane.surface, membrane.fine.synthesize_gradient(membrane.fine.analyze(values)));
}

}  // namespace

bool has_varying_bending(const Membrane& membrane) { return membrane.material.bending_modulus.size() > 0; }

double elastic_energy(const Membrane& membrane) {
  const Surface& s = membrane.surface;
  const Vector excess = s.mean_curvature - membrane.material.spontaneous_curvature;
  return membrane.material.bending_modulus.cwiseProduct(excess.cwiseAbs2()).dot(s.quadrature);
}

Matrix elastic_force(const Membrane& membrane) {
  const Surface& s = membrane.surface;
  const MembraneMaterial& material = membrane.material;
  const Eigen::ArrayXd excess = s.mean_curvature - material.spontaneous_curvature;
  const Vector moment_coefficients = membrane.fine.analyze(Vector(material.bending_modulus.array() * excess));
  const SphereDerivatives moment = membrane.fine.synthesize_hessian(moment_coefficients);
  const Eigen::ArrayXd m = moment.value.col(0).array();
  const Eigen::ArrayXd h = s.mean_curvature.array(), k = s.gauss_curvature.array();
  const Vector magnitude =
      -(surface_laplacian(s, moment).col(0).array() + 2.0 * m * (2.0 * h * h - k) - 2.0 * h * m * excess);
  Matrix force = magnitude.asDiagonal() * s.normal;
  force += Vector(excess.square()).asDiagonal() * gradient_of(membrane, material.bending_modulus);
  force -= Vector(2.0 * m).asDiagonal() * gradient_of(membrane, material.spontaneous_curvature);
  return force;
}

EffectRow bending_row() {
  return {kBending,
          [](const Model& model, const VesicleModel& vesicle) -> MadeEffect {
            if (!model.mobile || !vesicle.bending) return nullptr;
            return described([] {
              return EffectDescription{kBending,
                                       "f_b, Eq. (2), implicit through (28)",
                                       {{&LayerSelection::stokes_single, "velocity of f_b, Eq. (5)"}},
                                       {"change of H"}};
            });
          },
          [](Model&, VesicleModel& vesicle) { vesicle.bending.reset(); }};
}

}  // namespace vehd

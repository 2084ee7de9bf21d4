#include "bie/physics/elasticity_by_place.hpp"

namespace vehd {

namespace {

/// ∇_γ f of a field that is known by its values, [n_points x 3].
Matrix gradient_of(const Membrane& membrane, const Vector& values) {
  return surface_gradient(membrane.surface, membrane.fine.synthesize_gradient(membrane.fine.analyze(values)));
}

}  // namespace

bool bends_by_place(const Membrane& membrane) { return membrane.material.bending_modulus.size() > 0; }

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

}  // namespace vehd

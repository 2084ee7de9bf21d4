#include "bie/stepping/solve/sphere_spectrum.hpp"

#include "bie/physics/effects/viscosity_contrast.hpp"

namespace vehd {
namespace {

/// Stokes single layer of the unit sphere on V and W of one degree, over the eigenvalues of the viscosity contrast.
struct LayerSpectrum {
  double odd = 1.0;  ///< 2n + 1
  double v = 0.0;
  double w = 0.0;
};

LayerSpectrum layer_spectrum(const SphereFlow& sphere, int degree) {
  const double n = degree;
  const double odd = 2.0 * n + 1.0;
  const ContrastSpectrum contrast = contrast_spectrum(sphere.viscosity_ratio, degree);
  return {odd, n / (odd * (2.0 * n + 3.0)) / contrast.v,
          degree == 0 ? 0.0 : (n + 1.0) / (odd * (2.0 * n - 1.0)) / contrast.w};
}

/// curvature_increment of unit V.
double curvature_of_v(const SphereFlow& sphere, int degree) {
  const double n = degree;
  return 0.5 * (n - 1.0) * (n + 1.0) * (n + 2.0) / (sphere.radius * sphere.radius);
}

}  // namespace

Eigen::Matrix2d sphere_flow_block(const SphereFlow& sphere, int degree) {
  const double n = degree;
  const auto [odd, layer_v, layer_w] = layer_spectrum(sphere, degree);
  const double mobility = 1.0 / (sphere.viscosity * sphere.radius);

  // Coefficients of u on V and W for unit h and unit λ.
  const double stiffness =
      sphere.bending_modulus * n * (n + 1.0) + 2.0 * sphere.held_tension * sphere.radius * sphere.radius;
  const double bending = stiffness / odd * mobility;
  const double bending_v = -bending * layer_v;
  const double bending_w = bending * layer_w;
  const double tension = sphere.radius / odd * mobility;
  const double tension_v = tension * (n + 2.0) * layer_v;
  const double tension_w = tension * (n - 1.0) * layer_w;

  // curvature_increment and J ∇_γ·u of unit V and W.
  const double curvature_v = curvature_of_v(sphere, degree);
  const double curvature_w = -0.5 * (n - 1.0) * n * (n + 2.0) / (sphere.radius * sphere.radius);
  const double divergence_v = -(n + 1.0) * (n + 2.0) * sphere.radius;
  const double divergence_w = -n * (n - 1.0) * sphere.radius;

  Eigen::Matrix2d block;
  block(0, 0) = 1.0 - sphere.dt * (curvature_v * bending_v + curvature_w * bending_w);
  block(0, 1) = -sphere.dt * (curvature_v * tension_v + curvature_w * tension_w);
  block(1, 0) = divergence_v * bending_v + divergence_w * bending_w;
  block(1, 1) = divergence_v * tension_v + divergence_w * tension_w;
  return block;
}

double unresolved_curvature(const SphereFlow& sphere, int degree) {
  const auto [odd, layer_v, layer_w] = layer_spectrum(sphere, degree);
  const double held_v = -2.0 * sphere.held_tension * sphere.radius / (odd * sphere.viscosity) * layer_v;
  return 1.0 - sphere.dt * curvature_of_v(sphere, degree) * held_v;
}

Eigen::Matrix2d rigid_sphere_block(const SphereFlow& sphere, int degree) {
  const double n = degree;
  const auto [odd, layer_v, layer_w] = layer_spectrum(sphere, degree);

  // Coefficients of u on V and W for a unit normal force Y n = (W − V)/(2n+1) and for unit λ.
  const double normal = sphere.radius / (odd * sphere.viscosity);
  const double tension = 1.0 / (odd * sphere.viscosity);
  const Eigen::Matrix2d velocity{{-normal * layer_v, tension * (n + 2.0) * layer_v},
                                 {normal * layer_w, tension * (n - 1.0) * layer_w}};
  // u·n and J ∇_γ·u of unit V and W.
  const Eigen::Matrix2d constraint{{-(n + 1.0), n},
                                   {-(n + 1.0) * (n + 2.0) * sphere.radius, -n * (n - 1.0) * sphere.radius}};
  return constraint * velocity;
}

double uniform_tension_response(double radius, double viscosity, double viscosity_ratio) {
  return 0.1 * sphere_flow_block({radius, viscosity, 0.0, 0.0, viscosity_ratio}, 2)(1, 1);
}

}  // namespace vehd

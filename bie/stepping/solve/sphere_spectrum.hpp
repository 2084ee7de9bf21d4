#pragma once

#include <Eigen/Dense>

namespace vehd {

/// Physical parameters of the sphere behind the flow preconditioner.
struct SphereFlow {
  double radius;
  double viscosity;        ///< outside
  double bending_modulus;  ///< 0 without bending
  double dt;
  double viscosity_ratio = 1.0;
  double held_tension = 0.0;  ///< of the force 2 held_tension h n, see FlowOptions
};

/// FlowEquations on a sphere, degree n: rows curvature and divergence, columns h and λ.
/// With V = ∇Y − (n+1) Y r̂ and W = ∇Y + n Y r̂ the Stokes single layer has eigenvalues n/((2n+1)(2n+3)) and
/// (n+1)/((2n+1)(2n−1)); weighted densities carry R². A viscosity contrast divides them by those of
/// contrast_spectrum.
/// Accuracy: closed form; the assembled system meets it to 1e-10 (tests/stepping/solve/flow_system_test.cpp)
/// Source: the preconditioner of Veerapaneni et al. 2011
Eigen::Matrix2d sphere_flow_block(const SphereFlow& sphere, int n);

/// The entry of h in sphere_flow_block for the first degree above that of the position, which has V but neither W nor
/// bending.
double unresolved_curvature(const SphereFlow& sphere, int n);

/// The equations that hold a sphere in shape, degree n, without bending and dt: rows u·n and J ∇_γ·u, columns a force
/// c n and λ.
/// Accuracy: closed form; solves on spheres that it preconditions take few iterations
/// (tests/stepping/solve/tension_solve_test.cpp)
Eigen::Matrix2d rigid_sphere_block(const SphereFlow& sphere, int n);

/// Stand-in for the response of the area to a uniform tension, which vanishes on a sphere.
double uniform_tension_response(double radius, double viscosity, double viscosity_ratio);

}  // namespace vehd

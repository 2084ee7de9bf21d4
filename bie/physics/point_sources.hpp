#pragma once

#include <vector>

#include "bie/physics/electric.hpp"

namespace vehd {

/// Potential strength/(4π|x − y|) of a point source.
/// Source: paper, Example 1
struct PointSource {
  Vector3 position;
  double strength;
  bool inside;  ///< sources inside the surface generate the exterior potential, sources outside the interior one
};

/// Exact traces on the membrane of the harmonic potentials that the sources generate on either side, with the
/// jumps (34) that they imply.
/// Fluxes are along the outward normal.
/// Source: paper Eq. (34)
struct PointSourceFields {
  Vector potential_in, potential_out;  ///< [n_points]
  Matrix gradient_in, gradient_out;    ///< [n_points x 3]
  Vector flux_in, flux_out;            ///< [n_points]
};

/// The exact traces at the points of a surface.
/// Accuracy: rounding (tests/physics/example1_test.cpp)
PointSourceFields point_source_fields(const std::vector<PointSource>& sources, const Surface& surface);

/// Solution of (35) for any jumps.
struct JumpSolution {
  ElectricTraces traces;
  SolveReport report;
};

/// Harmonic potentials on both sides with [[φ]] = V_m and [[σ ∂φ/∂n]] = J_m, decaying at infinity:
/// (½ + ηS′) q = ηD′[V_m] + J_m/(σ_i + σ_e). Fluxes follow from q and their mean S′[q] − D′[V_m].
/// @param potential     V_m, coefficients [n_coefficients]
/// @param current_jump  J_m, values on the upsampled grid, [n_points]
/// @param tolerance     of the solve, see solve_second_kind
/// Accuracy: that of Example 1, see point_source_errors
/// Source: paper Eqs. (34), (35)
JumpSolution solve_jumps(const ElectricParameters& electric, const Membrane& membrane, const Vector& potential,
                         const Vector& current_jump, double tolerance);

/// Example 1 of the paper: errors of the solution of (35) for the jumps V_m and J_m of the point sources.
struct PointSourceErrors {
  double charge;               ///< max |q − q*| / max |q*| over the upsampled grid
  double force;                ///< max |f_E − f_E*| / max |f_E*|
  double charge_l2, force_l2;  ///< ‖q − q*‖/‖q*‖ and ‖f_E − f_E*‖/‖f_E*‖ in L2(γ)
  SolveReport report;
};

/// @param tolerance  of the solve, see solve_second_kind
/// Accuracy: errors of q at most 1.7e-3, 3.0e-4, 1.5e-5 and 8e-7 at p = 12, 16, 24 and 32 on shape (33), in at most 9
/// iterations (tests/physics/example1_test.cpp)
/// Source: paper Eqs. (33)–(35), Figure 1
PointSourceErrors point_source_errors(const ElectricParameters& electric, const std::vector<PointSource>& sources,
                                      const Membrane& membrane, double tolerance);

}  // namespace vehd

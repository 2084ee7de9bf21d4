#pragma once

#include <vector>

#include "bie/physics/electric.hpp"

namespace vehd {

/// Potential strength/(4π|x − y|) of a point source.
struct PointSource {
  Vector3 position;
  double strength;
  bool inside;  ///< sources inside the surface make the exterior potential, sources outside the interior one
};

/// Exact traces on the membrane of the harmonic potentials that the sources generate on either side, with the
/// jumps (34) that they imply.
struct PointSourceFields {
  Vector potential_in, potential_out;  ///< values on the upsampled grid
  Matrix gradient_in, gradient_out;
  Vector flux_in, flux_out;
};

PointSourceFields point_source_fields(const std::vector<PointSource>& sources, const Surface& surface);

/// Example 1 of the paper: solution of (35) for the jumps V_m and J_m of the point sources, against the exact one.
struct PointSourceErrors {
  double charge;               ///< max |q − q*| / max |q*| over the upsampled grid
  double force;                ///< max |f_E − f_E*| / max |f_E*|
  double charge_l2, force_l2;  ///< ‖q − q*‖/‖q*‖ and the same of f_E, in L2(γ)
  SolveReport report;
};

PointSourceErrors point_source_errors(const ElectricParameters& electric, const std::vector<PointSource>& sources,
                                      const Membrane& membrane, double tolerance);

}  // namespace vehd

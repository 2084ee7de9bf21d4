#pragma once

#include "bie/physics/electric.hpp"
#include "tests/support/membrane.hpp"

namespace vehd::testing {

/// Density g of Eq. (12) in a uniform field with a given V_m.
inline SecondKindSolution solve_density(const ElectricParameters& electric, const Membrane& membrane,
                                        const Vector& potential) {
  const Vector rhs = weighted_field_flux(membrane, electric.field) + weighted_hypersingular(membrane, potential);
  SecondKindSolution density = solve_second_kind(membrane, conductivity_contrast(electric), rhs, 1e-12);
  require_converged(density.report, "charge density");
  return density;
}

inline ElectricTraces solve_traces(const ElectricParameters& electric, const Membrane& membrane,
                                   const Vector& potential) {
  return electric_traces(electric, membrane, potential, solve_density(electric, membrane, potential));
}

}  // namespace vehd::testing

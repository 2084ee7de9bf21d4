#pragma once

#include <optional>
#include <vector>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/level.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/potential.hpp"

namespace vehd::fem_check {

/// Potentials at rising degree. Surface fields: q, flux_in = ∂φ_i/∂n and force (with given V_m or, with displacement
/// currents, given charges of both faces), Vm_of_charges and free_current = σ_i E_i − σ_e E_e (given charges), Vm and
/// q_steady (membrane law); samples: potential.
struct PotentialLevels {
  LevelSequence sequence;
  std::vector<PotentialSolution> solutions;  ///< of every level, V_m or charges given
  std::optional<PotentialSolution> steady;   ///< of the finest level, membrane law
};

/// Error of f_E on the finest level over its change from the level before.
double tail_of_force(const PotentialLevels& potential);

/// Problem with given V_m or, with displacement currents, given free charges of both faces, which determine V_m.
/// @param inputs  of all vesicles of the meshes
PotentialProblem given_problem(const std::vector<CheckInput>& inputs);

/// Solves the potential with V_m or charges given, and under the membrane law if the inputs have a steady solution.
/// @param inputs  of all vesicles of the meshes; the samples are those of the first
/// @throws SolveError
PotentialLevels solve_potential_levels(const std::vector<CheckInput>& inputs, Meshes& meshes,
                                       const Refinement& refinement, const Report& report);

}  // namespace vehd::fem_check

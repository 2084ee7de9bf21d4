#pragma once

#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// One vesicle of a state, with the results of its solves.
struct VesicleTask {
  const Model& model;
  const VesicleModel& vesicle;
  const NumericalSettings& settings;
  const MembraneSpace& space;
  const VesicleState& state;
  const Membrane& membrane;
  VesicleFields& fields;
  VesicleSolution& solution;
};

/// Solves for the electric fields of all vesicles of this rank and the rates of V_m or of the charges: from V_m, Eq.
/// (12); with displacement currents from the charges of the faces. In an averaged field it solves for the amplitudes of
/// V_m and q. All are zero without charge and field, see SolvedFields::electric_inactive.
/// @param limit   which value of the field applies if it jumps
/// @param solved  with the interaction; the iterations are added to it
/// @return  f_E of each, values on the upsampled grid, [n_points x 3]; empty where it is zero and for vesicles of other
///          ranks
/// @throws ConvergenceError naming the solve that failed
/// Source: paper Eqs. (4e), (12), (15), (32); docs/theory/electric.md
std::vector<Matrix> solve_electric(const std::vector<VesicleTask>& tasks, double time, Limit limit,
                                   SolvedFields& solved);

/// Computes the conductance of a membrane that porates and the rate of its state s; V_m must be known.
void solve_poration(const VesicleTask& task, double time, Limit limit);

/// Computes the forces on all membranes of this rank and their velocities, with the tensions that keep them
/// inextensible, Eqs. (2), (5), (27b).
/// @param forces_electric  f_E of each, values on the upsampled grid, [n_points x 3]; empty where it is zero
/// @param limit            which value of a waveform applies if it jumps
/// @param solved           with the interaction; the iterations are added to it
/// @throws ConvergenceError if the tensions do not converge
void solve_velocities(const std::vector<VesicleTask>& tasks, const std::vector<Matrix>& forces_electric, double time,
                      Limit limit, Instruments& instruments, SolvedFields& solved);

}  // namespace vehd

#pragma once

#include <vector>

#include "bie/stepping/evaluation/vesicle_task.hpp"

namespace vehd {

/// The electric fields of all vesicles of this rank and the rates of V_m or of the charges: from V_m, Eq. (12); with
/// displacement currents from the charges of the faces; in an averaged field the amplitudes of V_m and q. All are zero
/// where there is no charge and no field, see SolvedFields::electric_inactive.
/// @param limit   which value of the field counts where it jumps
/// @param solved  with the interaction; the iterations are added there
/// @return  f_E of each, values on the upsampled grid; empty where it is zero and for vesicles of other ranks
/// @throws ConvergenceError naming the solve that failed
/// Source: paper Eqs. (4e), (12), (15), (32); docs/theory/electric.md
std::vector<Matrix> solve_electric(const std::vector<VesicleTask>& tasks, double time, Limit limit,
                                   SolvedFields& solved);

/// The conductance of a membrane that porates, and how fast its state s changes; V_m must be known.
void solve_poration(const VesicleTask& task, double time, Limit limit);

}  // namespace vehd

#pragma once

#include "bie/support/ranks/ranks.hpp"

namespace vehd {

/// The processes that mpirun or srun has started together with this one; MPI ends with the last copy. A single rank,
/// without MPI, if this process was started on its own.
Ranks mpi_ranks();

/// Number of tasks that srun has started with this one but not connected by MPI, so that each of them is a single rank;
/// 1 if there are no others or they are connected.
int separate_tasks();

}  // namespace vehd

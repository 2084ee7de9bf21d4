#pragma once

#include "bie/support/ranks/ranks.hpp"

namespace vehd {

/// The processes that mpirun or srun has started together with this one; MPI ends with the last copy. A single rank,
/// without MPI, if this process was started on its own.
Ranks mpi_ranks();

}  // namespace vehd

#pragma once

#include "bie/support/ranks/ranks.hpp"

namespace vehd {

/// The processes that mpirun or srun has started this one with, until the last copy is gone; alone where it was started
/// by itself, and MPI is left alone then.
Ranks mpi_ranks();

}  // namespace vehd

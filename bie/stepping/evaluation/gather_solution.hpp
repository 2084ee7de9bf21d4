#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// Gives all ranks what the owner of each vesicle has solved for, its fields and rates, and images what follows from
/// their originals. Membranes, operators and what lives on a grid stay with their owner. Collective.
void gather_from_owners(const Shares& shares, const Exchange& exchange, SolvedFields& solved);

}  // namespace vehd

#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// Gives all ranks what the owner of each vesicle has solved for: its fields and rates. Membranes, operators and what
/// lives on a grid stay with their owner. Collective.
void gather_from_owners(const Shares& shares, SolvedFields& solved);

}  // namespace vehd

#pragma once

#include <vector>

#include "bie/physics/current_law.hpp"

namespace vehd {

/// The traces that go with the V of solve_laws. The mean of both fields is found from the layers, which smooth: free of
/// the truncation that aV − s_i would magnify; the jump of the fields follows from k_e E_e − k_i E_i = s_i + s_e.
/// Neither k may be zero.
/// @return  those of membranes of other ranks are empty
/// Source: paper Eqs. (7), (11), (13)
template <typename Scalar>
std::vector<TracesOf<Scalar>> traces_of_laws(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction,
                                             const std::vector<CurrentLaw<Scalar>>& laws,
                                             const std::vector<FieldOf<Scalar>>& potentials);

}  // namespace vehd

#pragma once

#include <array>
#include <string>

#include "bie/physics/model.hpp"
#include "bie/sphere/symmetry.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// The symmetries that a scene as a whole has at its start and keeps: every vesicle is its own image, the flow is, and
/// so is the field up to its sign; and those under which equal vesicles change places, see find_exchange. What `auto`
/// finds; deviations within 1e-12 of the size count as rounding.
/// Accuracy: what it finds changes no step by more than 1e-9 (tests/stepping/state/symmetry_test.cpp,
/// tests/stepping/state/fold_test.cpp)
Symmetry find_symmetry(const Model& model, const State& state);

/// In words: "axisymmetric about z, mirror z", "mirror y, half turn about y, inversion", "none"; of several vesicles
/// also "axisymmetric about z, vesicles exchanged by mirror z".
/// @param axes  their names; the third carries the poles
std::string symmetry_text(const Symmetry& symmetry, const std::array<std::string, 3>& axes = {"x", "y", "z"});

/// The part of the fields that is its own image; in a state, of every membrane.
SurfaceFields symmetric_part(const SymmetrySubspace& subspace, SurfaceFields fields);
/// The same of every membrane of a state.
State symmetric_part(const Symmetry& symmetry, State state);

}  // namespace vehd

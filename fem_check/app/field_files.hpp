#pragma once

#include <filesystem>

#include "fem_check/app/flow_levels.hpp"
#include "fem_check/app/potential_levels.hpp"

namespace vehd::fem_check {

/// The finest solutions; null if the problem is absent.
struct FinestSolutions {
  const PotentialLevels* potential = nullptr;
  const FlowLevels* flow = nullptr;
};

/// Writes surface.vtu (fields of both methods on γ and their differences), volume.vtu (φ, v and pressure of the finite
/// elements) and differences.dat for the figure.
/// @param inputs  of all vesicles
/// @param discretisation  whose mesh the solutions use
/// @throws InputError if a file cannot be written
void write_field_files(const std::filesystem::path& directory, const std::vector<CheckInput>& inputs,
                       const FinestSolutions& finest, const Discretisation& discretisation);

}  // namespace vehd::fem_check

#pragma once

#include <filesystem>

#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/app/result.hpp"

namespace vehd::fem_check {

/// What is compared, and where the files go.
struct CheckTask {
  std::filesystem::path input;
  std::filesystem::path directory;  ///< for the files of fields
  Refinement refinement;
  bool writes = true;  ///< false on all ranks but the first
};

/// Solves, compares and writes the files of fields.
/// @throws InputError, meshes::MeshError, SolveError
CheckResult run_check(const CheckTask& task, const Report& report);

}  // namespace vehd::fem_check

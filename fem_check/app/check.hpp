#pragma once

#include <filesystem>
#include <optional>

#include "fem_check/app/charging_levels.hpp"
#include "fem_check/app/compared_field.hpp"
#include "fem_check/app/flow_levels.hpp"
#include "fem_check/app/potential_levels.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/app/result.hpp"

namespace vehd::fem_check {

/// One check: its input files, output directory and options.
struct CheckTask {
  std::filesystem::path input;
  std::filesystem::path directory;                      ///< for the files of fields
  std::vector<std::filesystem::path> further_inputs{};  ///< other inputs of the same state, see run_check()
  bool quick = false;                                   ///< coarse elements
  double required = default_requirement;                ///< see compare()
  bool judges = true;                                   ///< whether this rank compares: the first one
  bool writes = true;                                   ///< whether this rank writes files: the last, otherwise idle
};

/// Finite-element solutions of one state, with which boundary-integral fields are compared.
struct SolvedState {
  ComparisonPoints points;  ///< radius and centre of the first vesicle
  std::optional<PotentialLevels> potential;
  std::optional<FlowLevels> flow;
  std::optional<LevelSequence> shape_flow;  ///< with several vesicles, f_b only
  std::optional<ChargingLevels> charging;
  double outer_radius = 0.0;
};

/// Solves the problems of all vesicles at rising degree; with several vesicles, only V_m and force given, and f_b.
/// @param geometry  discretisation of the highest degree, on which fields are compared
/// @throws SolveError
SolvedState solve_state(const std::vector<CheckInput>& inputs, Meshes& meshes, const Discretisation& geometry,
                        const Refinement& refinement, const Report& report);

/// Compares the fields and makes the rows of the table; solves nothing.
/// @param inputs  of the solved state; their boundary-integral and stored fields are judged
CheckResult judge(const std::vector<CheckInput>& inputs, const SolvedState& solved, double required);

/// Solves, compares and writes the files of fields.
/// @return the result for the input, then for each further one, judged by the solutions of the first; empty on a rank
///         that does not judge
/// @throws InputError, meshes::MeshError, SolveError
std::vector<CheckResult> run_check(const CheckTask& task, const Report& report);

}  // namespace vehd::fem_check

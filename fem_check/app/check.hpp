#pragma once

#include <filesystem>
#include <optional>

#include "fem_check/app/charging_levels.hpp"
#include "fem_check/app/flow_levels.hpp"
#include "fem_check/app/potential_levels.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/question_maker.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/app/result.hpp"

namespace vehd::fem_check {

/// Fields to compare, and the folder of the files.
struct CheckTask {
  std::filesystem::path input;
  std::filesystem::path directory;                      ///< for the files of fields
  std::vector<std::filesystem::path> further_inputs{};  ///< of the same state, see run_check()
  bool quick = false;                                   ///< coarse elements
  double required = default_requirement;                ///< see compare()
  bool judges = true;                                   ///< false on all ranks but the first
  bool writes = true;                                   ///< false on all ranks but the last, which has no other work
};

/// Results of the finite elements for one state, with which boundary-integral numbers are compared.
struct SolvedState {
  ComparisonPlaces places;  ///< radius and centre are those of the first vesicle
  std::optional<PotentialLevels> potential;
  std::optional<FlowLevels> flow;
  std::optional<LevelSequence> shape_flow;  ///< of several vesicles f_b alone
  std::optional<ChargingLevels> charging;
  double outer_radius = 0.0;
};

/// Solves the problems that the inputs of all vesicles have, at rising degree: of several vesicles those in which V_m
/// and the force are given, and f_b of their shapes. @throws SolveError
/// @param geometry  mesh of the finest geometry, on which fields are compared
SolvedState solve_state(const std::vector<CheckInput>& inputs, Meshes& meshes, const Discretisation& geometry,
                        const Refinement& refinement, const Report& report);

/// Compares; nothing is solved. The rows of the table are made here.
/// @param inputs  of the state that was solved; their boundary-integral and stored numbers are the ones judged
CheckResult judge(const std::vector<CheckInput>& inputs, const SolvedState& solved, double required);

/// Solves, compares and writes the files of fields.
/// @return the result of the input, then that of each further one, judged by the solutions of the first; none on a rank
///         that does not judge
/// @throws InputError, meshes::MeshError, SolveError
std::vector<CheckResult> run_check(const CheckTask& task, const Report& report);

}  // namespace vehd::fem_check

#pragma once

#include <map>
#include <string>
#include <vector>

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// Fields by name: one column per comparison point on γ, or per sample point.
using FieldValues = std::map<std::string, Eigen::MatrixXd>;

/// Name of the problem of the flow determined by the shape.
constexpr const char* shape_flow_problem = "flow from the shape";

/// Name of the problem of f_b on several vesicles, without a flow.
constexpr const char* bending_problem = "bending";

/// Name of the problem of V_m advanced in time.
constexpr const char* charging_problem = "charging";

/// One discrete solution: its fields at the points of the comparison, and its cost.
struct Level {
  std::string problem;  ///< "potential", "flow" or one of the names above
  int degree = 0;
  double outer_radius = 0.0;
  int n_cells = 0;
  long n_unknowns = 0;
  double seconds = 0.0;
  std::size_t peak_memory_bytes = 0;
  FieldValues surface;
  FieldValues samples;
};

/// Settings of a solution other than the elements.
struct SolveSettings {
  double tolerance;  ///< of the linear solvers
  int exterior_degree = usual_exterior_degree;
  bool from_zero = false;  ///< the linear solvers do not start from the previous level
};

/// Smallest tolerance of the linear solvers for a flow that is a small correction of another one.
constexpr double tolerance_of_changes = 1e-4;

/// Tolerance of LevelSequence::loose over that of the levels.
constexpr double loose_factor = 100.0;
/// Exterior degree of LevelSequence::truncated: two below that of the levels, since shapes with a centre of symmetry
/// have only every second harmonic.
constexpr int truncated_exterior_degree = usual_exterior_degree - 2;

/// All levels of one problem on one mesh, coarse to fine, and two repetitions of one of them: with fewer exact
/// harmonics at the outer sphere, and with a looser tolerance of the linear solvers.
struct LevelSequence {
  std::vector<Level> levels;
  double tolerance = 0.0;  ///< of the linear solvers
  int repeated = 0;        ///< index of the repeated level
  Level truncated;         ///< repetition with truncated_exterior_degree
  Level loose;             ///< repetition with a tolerance larger by loose_factor
};

}  // namespace vehd::fem_check

#pragma once

#include <map>
#include <string>
#include <vector>

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// Fields by name: one column per point of the comparison on γ, or per sample point.
using FieldValues = std::map<std::string, Eigen::MatrixXd>;

/// Name of the flow that follows from the shape.
constexpr const char* shape_flow_problem = "flow from the shape";

/// Name of f_b of the shapes of several vesicles, without a flow.
constexpr const char* bending_problem = "bending";

/// Name of V_m that is advanced in time.
constexpr const char* charging_problem = "charging";

/// One discrete solution: its fields at the points of the comparison, and what it took.
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

/// Settings of a solve besides the elements.
struct SolveSettings {
  double tolerance;  ///< of the linear solvers
  int exterior_degree = usual_exterior_degree;
  bool from_zero = false;  ///< the linear solvers do not begin from the level before
};

/// Of the linear solvers, at least, for a flow that is a small part of another one.
constexpr double tolerance_of_changes = 1e-4;

/// Tolerance of LevelSequence::rough over that of the levels.
constexpr double rough_factor = 100.0;
/// Exterior degree of LevelSequence::truncated: two below that of the levels, as shapes with a centre of symmetry make
/// every other harmonic alone.
constexpr int truncated_exterior_degree = usual_exterior_degree - 2;

/// All levels of one problem on one mesh, coarse to fine, and one of them twice again: with fewer harmonics exact at
/// the outer sphere, and with linear solvers that stop sooner.
struct LevelSequence {
  std::vector<Level> levels;
  int repeated = 0;  ///< which of them
  Level truncated;   ///< its repetition with truncated_exterior_degree
  Level rough;       ///< its repetition with a tolerance larger by rough_factor
};

}  // namespace vehd::fem_check

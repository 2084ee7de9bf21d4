#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/level.hpp"

namespace vehd::fem_check {

/// Relative L2(γ) and maximum norm of a difference; over sample points, root mean square and maximum.
struct Norms {
  double l2 = 0.0;
  double max = 0.0;
};

/// One field by both methods. The finest level stands against the higher order.
struct FieldComparison {
  std::string name;   ///< in the JSON
  std::string label;  ///< in the table
  Norms difference;
  Norms levels_change;           ///< last level against the one before
  Norms truncation;              ///< of the outer sphere, from one further out
  double solver = 0.0;           ///< what the linear solvers leave
  Norms bie_change;              ///< order p against the higher order
  std::optional<double> order;   ///< observed, in the mesh size N^(−1/3), N unknowns
  std::vector<Norms> of_levels;  ///< difference of every level that has the field

  [[nodiscard]] double fem_error() const { return levels_change.l2 + truncation.l2 + solver; }
  [[nodiscard]] double bie_error() const { return bie_change.l2; }
  [[nodiscard]] bool agrees() const { return difference.l2 <= fem_error() + bie_error(); }
};

/// How a field is compared.
struct FieldQuestion {
  std::string name;
  std::string label;
  std::string values;                 ///< its name in the levels
  Eigen::MatrixXd bie, bie_high;      ///< boundary-integral values at the points, [components x n]
  Vector weight;                      ///< of the points
  std::vector<Eigen::Index> columns;  ///< of the level's values; empty: all
  bool is_sample = false;
  double natural_size = 1.0;  ///< of such a field in this problem
  double solver_tolerance = 0.0;
};

/// The errors of both methods and what stands between them.
FieldComparison compare(const FieldQuestion& question, const LevelSequence& sequence);

}  // namespace vehd::fem_check

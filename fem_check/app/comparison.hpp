#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem_check/app/compared_field.hpp"
#include "fem_check/app/level.hpp"

namespace vehd::fem_check {

/// Relative L2(γ) and maximum norms of a difference; at sample points, root mean square and maximum.
struct Norms {
  double l2 = 0.0;
  double max = 0.0;
};

/// Verdict of a comparison.
enum class Verdict {
  agree,     ///< the difference is within the errors, and both errors are as small as required
  disagree,  ///< the difference is larger than both errors together
  undecided  ///< the difference is within the errors, but these are too large
};

/// "agree", "disagree", "undecided".
const char* name_of(Verdict verdict);

/// Comparison of one field: the finest level against the boundary integrals in the order of the state.
struct FieldComparison {
  std::string name;   ///< in the JSON
  std::string label;  ///< in the table
  RowGroup group = RowGroup::fields;
  Norms difference;
  Norms levels_change;           ///< last level against the one before
  double tail = 1.0;             ///< error of the last level over that change; above 1 if levels converge slowly
  Norms truncation;              ///< of the outer sphere, from a solution with fewer exact harmonics
  double solver = 0.0;           ///< error left by the linear solvers, from looser tolerances
  double time = 0.0;             ///< error of the time steps; ComparedField::time_error
  Norms bie_change;              ///< degree p against the other degree
  double bie_tail = 1.0;         ///< error of degree p over that change
  double bie_further = 0.0;      ///< ComparedField::further_error
  double floor = 0.0;            ///< rounding and solver errors of the run, see compare()
  std::optional<double> order;   ///< observed, in the mesh size N^(−1/3), N unknowns
  std::vector<Norms> of_levels;  ///< difference at every level that has the field
  Reference reference = Reference::elements;
  Verdict verdict = Verdict::undecided;
  bool has_work_row = false;  ///< ComparedField::has_work_row

  [[nodiscard]] double fem_error() const { return tail * levels_change.l2 + truncation.l2 + solver + time; }
  [[nodiscard]] double bie_error() const { return bie_tail * bie_change.l2 + bie_further + floor; }
  /// Whether the row contributes to the verdict of the whole check.
  [[nodiscard]] bool counts() const { return !has_work_row || verdict != Verdict::undecided; }
};

/// Convergence of the levels of a field.
struct Convergence {
  double order = 0.0;  ///< observed from the last three levels, in the mesh size N^(−1/3), N unknowns
  double tail = 1.0;   ///< error of the last level, over its change from the level before
};

/// Convergence of a surface field of a sequence, in the root mean square over the points; empty unless there are three
/// different levels.
std::optional<Convergence> convergence_of(const LevelSequence& sequence, const std::string& field);

/// Requirements on both methods.
struct Requirement {
  double error = 0.0;             ///< largest error of each method, relative to the field, for which both agree
  double solver_tolerance = 0.0;  ///< at which the solvers of the run stopped
};

/// Computes the errors of both methods and the difference between them.
///
/// Errors are relative to the size of the field but at least to the required fraction of its natural size, below which
/// it counts as zero. The error of the run includes rounding and solver errors relative to the natural size.
FieldComparison compare(const ComparedField& compared, const LevelSequence& sequence, const Requirement& required);

}  // namespace vehd::fem_check

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

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

/// Reference of a comparison.
enum class Judge {
  elements,            ///< the finite elements
  boundary_integrals,  ///< a new boundary-integral solution, without finite elements
  constraint           ///< zero, as the constraint of the membrane requires
};

/// "elements", "boundary integrals", "constraint".
const char* name_of(Judge judge);

/// Part of the table to which a row belongs.
enum class RowGroup {
  fields,      ///< shape, V_m and force are given
  from_shape,  ///< shape, V_m and material parameters are given
  stored,      ///< the field judged is stored in the snapshot
  in_time      ///< advanced from an earlier snapshot
};

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
  double time = 0.0;             ///< error of the time steps; FieldQuestion::time_error
  Norms bie_change;              ///< degree p against the other degree
  double bie_tail = 1.0;         ///< error of degree p over that change
  double bie_further = 0.0;      ///< FieldQuestion::further_error
  double floor = 0.0;            ///< rounding and solver errors of the run, see compare()
  std::optional<double> order;   ///< observed, in the mesh size N^(−1/3), N unknowns
  std::vector<Norms> of_levels;  ///< difference at every level that has the field
  Judge judge = Judge::elements;
  Verdict verdict = Verdict::undecided;
  bool has_work_row = false;  ///< FieldQuestion::has_work_row

  [[nodiscard]] double fem_error() const { return tail * levels_change.l2 + truncation.l2 + solver + time; }
  [[nodiscard]] double bie_error() const { return bie_tail * bie_change.l2 + bie_further + floor; }
  /// Whether the row contributes to the verdict of the whole check.
  [[nodiscard]] bool counts() const { return !has_work_row || verdict != Verdict::undecided; }
};

/// Degrees of two solutions of one field; equal if a change between them is not due to their degrees.
struct Degrees {
  int judged = 0, other = 0;
  /// Factor by which the coefficients decrease from one degree to the other, in the finer solution; empty: unknown.
  std::optional<double> decay;
};

/// A field to compare, [components x points].
struct FieldQuestion {
  std::string name;
  std::string label;
  RowGroup group = RowGroup::fields;
  Eigen::MatrixXd judged;         ///< the field that is judged
  Eigen::MatrixXd bie, bie_high;  ///< boundary integrals at both degrees; their change estimates the error of `judged`
  Degrees degrees;                ///< of `bie` and `bie_high`
  Eigen::MatrixXd further_error;  ///< other errors of `judged`; empty: none
  Eigen::MatrixXd time_error;     ///< error of the levels due to their time steps; empty: none
  Judge judge = Judge::elements;  ///< otherwise `bie` is the reference
  std::string values;             ///< name of the reference field in the levels
  /// Maps a field of the levels to the field that is compared, both [components x points]; empty: the identity.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> from_level;
  Vector weight;                      ///< quadrature weights of the points
  std::vector<Eigen::Index> columns;  ///< columns of the level's values; empty: all
  bool is_sample = false;
  /// Another row compares the work of this force, and counts instead if this row is undecided.
  bool has_work_row = false;
  /// Typical size of such a field in this problem, root mean square: that of its terms, which can cancel.
  double natural_size = 1.0;
  /// Root mean square of the whole field if the points are only a part of it; 0: the points are all of it.
  double whole_size = 0.0;
  /// Error of the levels relative to the natural size, over the tolerance of their solvers, if it can exceed the one
  /// that looser tolerances show: where those already spoil the field. 0: it cannot.
  double solver_magnification = 0.0;
  /// Errors are relative to the natural size, whatever the size of the field: its terms can cancel.
  bool is_remainder = false;
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
FieldComparison compare(const FieldQuestion& question, const LevelSequence& sequence, const Requirement& required);

}  // namespace vehd::fem_check

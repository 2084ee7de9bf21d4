#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem_check/app/level.hpp"

namespace vehd::fem_check {

/// Relative L2(γ) and maximum norm of a difference; over sample points, root mean square and maximum.
struct Norms {
  double l2 = 0.0;
  double max = 0.0;
};

/// Verdict of a comparison.
enum class Verdict {
  agree,     ///< the difference is within the errors, and both errors are as small as required
  disagree,  ///< the difference is larger than both errors together
  undecided  ///< the errors are too large to tell
};

/// "agree", "disagree", "undecided".
const char* name_of(Verdict verdict);

/// Reference of a comparison.
enum class Judge {
  elements,            ///< the finite elements
  boundary_integrals,  ///< what boundary integrals find anew: no element has a part in it
  constraint           ///< zero, which the constraint of the membrane makes it
};

/// "elements", "boundary integrals", "constraint".
const char* name_of(Judge judge);

/// Part of the table that a row belongs to.
enum class RowGroup {
  fields,      ///< shape, V_m and force given
  from_shape,  ///< shape, V_m and the physics given
  stored,      ///< the number judged is one of the snapshot
  in_time      ///< advanced from an earlier snapshot
};

/// One field by both methods: the finest level against the boundary integrals in the order of the state.
struct FieldComparison {
  std::string name;   ///< in the JSON
  std::string label;  ///< in the table
  RowGroup group = RowGroup::fields;
  Norms difference;
  Norms levels_change;           ///< last level against the one before
  double tail = 1.0;             ///< what the last level leaves, over that change; above 1 where levels converge slowly
  Norms truncation;              ///< of the outer sphere, from fewer harmonics that are exact there
  double solver = 0.0;           ///< what the linear solvers leave, from coarser ones
  double time = 0.0;             ///< of the steps in time; FieldQuestion::time_error
  Norms bie_change;              ///< degree p against the other degree
  double bie_tail = 1.0;         ///< what degree p leaves, over that change
  double bie_further = 0.0;      ///< FieldQuestion::further_error
  double floor = 0.0;            ///< of rounding and of the solvers of the run, see compare()
  std::optional<double> order;   ///< observed, in the mesh size N^(−1/3), N unknowns
  std::vector<Norms> of_levels;  ///< difference of every level that has the field
  Judge judge = Judge::elements;
  Verdict verdict = Verdict::undecided;
  bool has_work_row = false;  ///< FieldQuestion::has_work_row

  [[nodiscard]] double fem_error() const { return tail * levels_change.l2 + truncation.l2 + solver + time; }
  [[nodiscard]] double bie_error() const { return bie_tail * bie_change.l2 + bie_further + floor; }
  /// In the verdict of the whole check.
  [[nodiscard]] bool counts() const { return !has_work_row || verdict != Verdict::undecided; }
};

/// Degrees of two solutions of one field; equal where a change between them has nothing to do with their degrees.
struct Degrees {
  int judged = 0, other = 0;
  /// Of the size of the coefficients from one of the two to the other, in the finer solution; empty: not known.
  std::optional<double> decay;
};

/// Values that are compared, at points, [components x points].
struct FieldQuestion {
  std::string name;
  std::string label;
  RowGroup group = RowGroup::fields;
  Eigen::MatrixXd judged;         ///< the number under judgement
  Eigen::MatrixXd bie, bie_high;  ///< boundary integrals at both degrees, whose change estimates the error of `judged`
  Degrees degrees;                ///< of these two
  Eigen::MatrixXd further_error;  ///< what else that number may be off by; empty: nothing
  Eigen::MatrixXd time_error;     ///< of what the levels have, by their steps in time; empty: none
  Judge judge = Judge::elements;  ///< else it is judged by `bie`
  std::string values;             ///< name in the levels of what the elements judge by
  /// From what the levels have to what is judged; empty: the same.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> from_level;
  Vector weight;                      ///< of the points
  std::vector<Eigen::Index> columns;  ///< of the level's values; empty: all
  bool is_sample = false;
  /// Another row judges the work of this force: where this row is undecided, that one counts in its place.
  bool has_work_row = false;
  /// Of such a field in this problem, root mean square: the terms that it is made of, of which it may be what remains.
  double natural_size = 1.0;
  /// Of the whole field, root mean square, where the points are a part of those that it is known at; 0: these are all.
  double whole_size = 0.0;
  /// Relative to the natural size whatever the size of the field: a sum of terms of that size that may cancel.
  bool is_remainder = false;
};

/// How the levels of a field converge.
struct Convergence {
  double order = 0.0;  ///< observed from the last three, in the mesh size N^(−1/3), N unknowns
  double tail = 1.0;   ///< what the last level leaves, over the change to it
};

/// Of a surface field of a sequence; nothing where it has less than three levels that differ. Root mean square over the
/// points.
std::optional<Convergence> convergence_of(const LevelSequence& sequence, const std::string& field);

/// Requirements on both methods.
struct Requirement {
  double error = 0.0;             ///< share of the field that each error may reach for both to agree
  double solver_tolerance = 0.0;  ///< at which the solvers of the run stop
};

/// The errors of both methods and what stands between them.
///
/// A field is measured by its size, and a smaller one than the required share of its natural size by that share: it
/// vanishes for what is required. No error is below what rounding and the solvers of the run leave of the natural size.
FieldComparison compare(const FieldQuestion& question, const LevelSequence& sequence, const Requirement& required);

}  // namespace vehd::fem_check

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// Reference of a comparison.
enum class Reference {
  elements,            ///< the finite elements
  boundary_integrals,  ///< a new boundary-integral solution, without finite elements
  constraint           ///< zero, as the constraint of the membrane requires
};

/// "elements", "boundary integrals", "constraint".
const char* name_of(Reference reference);

/// Part of the table to which a row belongs.
enum class RowGroup {
  fields,      ///< shape, V_m and force are given
  from_shape,  ///< shape, V_m and material parameters are given
  stored,      ///< the field judged is stored in the snapshot
  in_time      ///< advanced from an earlier snapshot
};

/// Degrees of two solutions of one field; equal if a change between them is not due to their degrees.
struct Degrees {
  int judged = 0, other = 0;
  /// Factor by which the coefficients decrease from one degree to the other, in the finer solution; empty: unknown.
  std::optional<double> decay;
};

/// A field to compare, [components x points].
struct ComparedField {
  std::string name;
  std::string label;
  RowGroup group = RowGroup::fields;
  Eigen::MatrixXd judged;         ///< the field that is judged
  Eigen::MatrixXd bie, bie_high;  ///< boundary integrals at both degrees; their change estimates the error of `judged`
  Degrees degrees;                ///< of `bie` and `bie_high`
  Eigen::MatrixXd further_error;  ///< other errors of `judged`; empty: none
  Eigen::MatrixXd time_error;     ///< error of the levels due to their time steps; empty: none
  Reference reference = Reference::elements;  ///< otherwise `bie` is the reference
  std::string values;                         ///< name of the reference field in the levels
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

/// Points at which fields are compared, and the length scale.
struct ComparisonPoints {
  SurfacePoints surface;
  double radius = 1.0;               ///< of the shape
  Vector3 centre = Vector3::Zero();  ///< of the shape
};

/// Degree of a field with (degree + 1)² harmonic coefficients, [n_coefficients x components].
int degree_of(const Eigen::MatrixXd& coefficients);

/// Typical sizes of the fields of this problem, root mean squares.
struct NaturalSizes {
  double potential = 0.0, field = 0.0;  ///< of E_∞ and V_m together
  double charge = 0.0;                  ///< due to the difference of conductivities
  double electric_force = 0.0, current = 0.0;
  double force = 0.0, velocity = 0.0, rate = 0.0;  ///< of the flow; rate: of strain
};

/// Natural sizes for an input at the points of comparison.
NaturalSizes natural_sizes(const CheckInput& input, const ComparisonPoints& at);

/// Root mean square over γ of a field given by coefficients, [n_coefficients x components]; 0 if it is empty.
double mean_size(const Eigen::MatrixXd& coefficients, const SurfacePoints& points);

/// A field on γ given by coefficients, [n_coefficients x components], whose number gives their degrees.
/// @param values  name of the reference field in the levels
ComparedField field_on_surface(const ComparisonPoints& at, const std::string& name, const std::string& label,
                               const std::string& values, const Eigen::MatrixXd& judged, const Eigen::MatrixXd& bie,
                               const Eigen::MatrixXd& bie_high, double natural_size);

/// Removes the undetermined uniform part of a tension or its force.
ComparedField without_uniform_tension(ComparedField compared, const SurfacePoints& points);

/// Subtracts `of_points`, [components x points], from all values of a field.
ComparedField without(ComparedField compared, const Eigen::MatrixXd& of_points);

}  // namespace vehd::fem_check

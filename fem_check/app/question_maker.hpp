#pragma once

#include <string>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/comparison.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// Points at which fields are compared, and the length scale.
struct ComparisonPlaces {
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
NaturalSizes natural_sizes(const CheckInput& input, const ComparisonPlaces& places);

/// Root mean square over γ of a field given by coefficients, [n_coefficients x components]; 0 if it is empty.
double mean_size(const Eigen::MatrixXd& coefficients, const SurfacePoints& points);

/// Makes questions about fields on γ.
class QuestionMaker {
 public:
  explicit QuestionMaker(const ComparisonPlaces& places) : places_(places) {}

  /// Question about fields given by coefficients, [n_coefficients x components], whose number gives their degrees;
  /// reference: `values` of the levels.
  [[nodiscard]] FieldQuestion on_surface(const std::string& name, const std::string& label, const std::string& values,
                                         const Eigen::MatrixXd& judged, const Eigen::MatrixXd& bie,
                                         const Eigen::MatrixXd& bie_high, double natural_size) const;

 private:
  const ComparisonPlaces& places_;
};

/// Removes the undetermined uniform part from a question about a tension or its force.
FieldQuestion without_uniform_tension(FieldQuestion question, const SurfacePoints& points);

/// Subtracts `of_points`, [components x points], from all compared values of a question.
FieldQuestion without(FieldQuestion question, const Eigen::MatrixXd& of_points);

}  // namespace vehd::fem_check

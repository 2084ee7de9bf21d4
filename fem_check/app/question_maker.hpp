#pragma once

#include <string>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/comparison.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// Where fields are compared, and the length that goes with it.
struct ComparisonPlaces {
  SurfacePoints surface;
  double radius = 1.0;               ///< of the shape
  Vector3 centre = Vector3::Zero();  ///< of the shape
};

/// Of harmonics, of which there are (degree + 1)².
int degree_of(const Eigen::MatrixXd& coefficients);

/// Sizes that fields of this problem have by nature, root mean squares.
struct NaturalSizes {
  double potential = 0.0, field = 0.0;  ///< E_∞ and V_m together
  double charge = 0.0;                  ///< of the difference of conductivities
  double electric_force = 0.0, current = 0.0;
  double force = 0.0, velocity = 0.0, rate = 0.0;  ///< of the flow; rate: of strain
};

/// For an input and its places.
NaturalSizes natural_sizes(const CheckInput& input, const ComparisonPlaces& places);

/// Root mean square over γ of a field in coefficients; 0 where it is absent.
double mean_size(const Eigen::MatrixXd& coefficients, const SurfacePoints& points);

/// Makes questions about fields on γ.
class QuestionMaker {
 public:
  explicit QuestionMaker(const ComparisonPlaces& places) : places_(places) {}

  /// Of coefficients, whose numbers tell their degrees; judged by `values` of the levels.
  [[nodiscard]] FieldQuestion on_surface(const std::string& name, const std::string& label, const std::string& values,
                                         const Eigen::MatrixXd& judged, const Eigen::MatrixXd& bie,
                                         const Eigen::MatrixXd& bie_high, double natural_size) const;

 private:
  const ComparisonPlaces& places_;
};

/// A question about a tension, or its force, without the uniform part, which is undetermined.
FieldQuestion without_uniform_tension(FieldQuestion question, const SurfacePoints& points);

/// A question with `of_points` subtracted from all compared values.
FieldQuestion without(FieldQuestion question, const Eigen::MatrixXd& of_points);

}  // namespace vehd::fem_check

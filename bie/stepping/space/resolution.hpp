#pragma once

#include "bie/physics/model.hpp"
#include "bie/physics/parameters.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// Ratio of the visible effect of high degrees to the bounds of Resolution: 1 if it is unknown.
struct VisibleShare {
  double shape = 1.0;
  double potential = 1.0;  ///< of V_m
};

/// Visible share of the upper half of the degrees, n > p/2. Their part x_h of x moves the surface by n·x_h; the rest
/// moves points along it, which is invisible. They change V_m at a fixed point by V_h − ∇_γV_m·x_h. Each share is the
/// largest value at the nodes over the sum of the bounds; 1 without such degrees.
/// @param fine  transform between the degree of the membrane and a grid
/// Accuracy: exact for the formulas (tests/stepping/space/visible_share_test.cpp)
VisibleShare visible_share(const SphereTransform& fine, const SurfaceFields& membrane);

/// Scale of errors of V_m: its largest value, or a tenth of |E| times the radius if that is larger.
double potential_scale(const AppliedField& electric, double radius, double largest);

/// Scale of errors of q, or its amplitude, of a vesicle: the largest value, or a tenth of η|E| if that is larger.
/// [potential/length]
double charge_scale(const Model& model, std::size_t vesicle, double largest);

/// Scale of errors of ∫λ dA: ∫|λ| dA, or a tenth of κ_B/R² over the sphere if that is larger. [energy]
double tension_scale(const Model& model, std::size_t vesicle, double largest);

/// Decay of the coefficients of one membrane with the degree.
/// Accuracy: an estimate; for a geometric spectrum 0.9 to 3 times the truncation error
/// (tests/stepping/adaptive_evolution_test.cpp)
class Resolution {
 public:
  /// @param vesicle  whose spectra are examined
  /// @param share    visible share of the bounds
  Resolution(const Model& model, const VesicleState& vesicle, VisibleShare share = {});
  /// Resolution of a vesicle in an averaged field, whose V_m is not part of the state.
  /// @param potential  amplitude of V_m, of the degree of the vesicle, [n_coefficients x 2]
  Resolution(const Model& model, const VesicleState& vesicle, const Matrix& potential, VisibleShare share = {});

  /// Estimated contribution of the degrees above p, in the maximum norm, to x over the radius or to V_m over its scale,
  /// whichever is larger. A geometric series extrapolates the upper half of the spectrum.
  [[nodiscard]] double remainder() const;
  /// remainder() at a higher degree, or of the state truncated to a lower one.
  [[nodiscard]] double remainder_at(int order) const;
  /// The least even degree, from `lowest` to `highest`, whose remainder is below the target. For a degree lower than
  /// the state's this includes the estimate from the truncated state: a spectrum that ends on a plateau leaves out more
  /// than the degrees that were cut.
  [[nodiscard]] int order_for(double target, int lowest, int highest) const;

 private:
  struct Tail {
    Vector bound;        // of each degree, the larger of x and V_m; decreasing
    double decay = 0.0;  // from degree to degree

    [[nodiscard]] double beyond(int order) const;
  };
  [[nodiscard]] int last() const { return static_cast<int>(shape_.size()) - 1; }
  [[nodiscard]] Tail tail_of_cut(int order) const;

  Vector shape_;                  // bounds of x over the radius, or of material properties, by degree
  Vector potential_;              // of V_m; empty without electricity
  double potential_share_ = 1.0;  // visible share of them
  double least_scale_ = 0.0;      // of V_m; 0 without a field
};

}  // namespace vehd

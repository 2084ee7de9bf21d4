#pragma once

#include "bie/physics/model.hpp"
#include "bie/physics/parameters.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// Visible share of the bounds of Resolution for the effect of high degrees: 1 if it is unknown.
struct VisibleShare {
  double shape = 1.0;
  double potential = 1.0;  ///< of V_m
};

/// The share of the upper half of the degrees, n > p/2. Their part x_h of x moves the surface by n·x_h; the rest moves
/// points along it, which is invisible. Their part of V_m changes it at a fixed place by V_h − ∇_γV_m·x_h. The largest
/// of either at the nodes over the sum of the bounds is the share; 1 where there are no such degrees.
/// @param fine  transform between the degree of the membrane and a grid
/// Accuracy: exact for the formulas (tests/stepping/space/visible_share_test.cpp)
VisibleShare visible_share(const SphereTransform& fine, const SurfaceFields& membrane);

/// Scale of errors of V_m: its largest value, or a tenth of the largest V_m that the field can charge.
double potential_scale(const AppliedField& electric, double radius, double largest);

/// Scale of errors of q, or its amplitude, of a vesicle: the largest value, or a share of η|E| where that is more.
/// [potential/length]
double charge_scale(const Model& model, std::size_t vesicle, double largest);

/// Scale of errors of ∫λ dA: ∫|λ| dA, or a share of κ_B/R² over the sphere where that is more. [energy]
double tension_scale(const Model& model, std::size_t vesicle, double largest);

/// Decay of the coefficients of one membrane with the degree.
/// Accuracy: an estimate; of a geometric spectrum between 0.9 and 3 times what is left out
/// (tests/stepping/adaptive_evolution_test.cpp)
class Resolution {
 public:
  /// @param vesicle  of the state whose spectra are looked at
  /// @param share    of what the degrees could do at most that counts
  Resolution(const Model& model, const VesicleState& vesicle, VisibleShare share = {});
  /// A vesicle in an averaged field, whose V_m is no part of the state.
  /// @param potential  amplitude of V_m, of the degree of the vesicle, [n_coefficients x 2]
  Resolution(const Model& model, const VesicleState& vesicle, const Matrix& potential, VisibleShare share = {});

  /// Estimate of what the degrees above p would add, in the maximum norm, to x over the radius or to V_m over its
  /// scale, whichever is more. A geometric series continues the upper half of the spectrum.
  [[nodiscard]] double remainder() const;
  /// remainder() of a higher degree, or of the state truncated at a lower one.
  [[nodiscard]] double remainder_at(int order) const;
  /// The least even degree, from `lowest` to `highest`, whose remainder is below the target. Of a lower degree than the
  /// state's that holds for the state cut there as well: a spectrum that ends on a plateau leaves out more than the
  /// degrees that were cut.
  [[nodiscard]] int order_for(double target, int lowest, int highest) const;

 private:
  struct Tail {
    Vector bound;        // of each degree, the larger of x and V_m; falling
    double decay = 0.0;  // from degree to degree

    [[nodiscard]] double beyond(int order) const;
  };
  [[nodiscard]] int last() const { return static_cast<int>(shape_.size()) - 1; }
  [[nodiscard]] Tail tail_of_cut(int order) const;

  Vector shape_;                  // bounds of x over the radius, or of the other field, by degree
  Vector potential_;              // of V_m; empty without electricity
  double potential_share_ = 1.0;  // of them that counts
  double least_scale_ = 0.0;      // of V_m; 0 without a field
};

}  // namespace vehd

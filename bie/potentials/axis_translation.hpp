#pragma once

#include <span>
#include <vector>

#include "bie/potentials/solid_harmonics.hpp"
#include "bie/sphere/rotation.hpp"

namespace vehd {

/// Moments of sources about their own centre, and where that is seen from.
struct DistantMoments {
  const RowMatrix* moments;  ///< AxisTranslation::turnable, [n_solid x columns]
  Vector3 offset;            ///< centre of the expansion minus that of the sources
  int degree;                ///< up to which they are translated; neighbours in a list best have similar ones
};

/// Coefficients of φ = R(x) L about a centre from the moments of sources about others, φ = Σ M_lm I_lm(x − centre).
/// Each way is turned into the axis, along which orders do not mix, and back: O(degree³) and no memory for a pair. A
/// turn to any direction is one about z, a quarter turn about x, one about z by the polar angle, and the quarter turn
/// back, so that products with the same small matrices serve many sources at once.
/// Accuracy: rounding of the truncated sums (tests/potentials/axis_translation_test.cpp)
/// Source: addition theorem of the solid harmonics, Epton and Dembart 1995; turns to the axis, White and Head-Gordon
/// 1996
class AxisTranslation {
 public:
  /// @param degree  highest of all moments and coefficients
  explicit AxisTranslation(int degree);

  /// Moments in the orthonormal harmonics that turns leave orthonormal, orders apart.
  /// @param moments  of all degrees, [n_solid x columns], see `moments`
  [[nodiscard]] RowMatrix turnable(const Matrix& moments) const;

  /// The sum over all sources, in their order.
  /// @param columns  1; or 4: charges A_1, A_2, A_3 and B = Σ (y − centre of its sources)·A(y), which becomes that of
  ///     the new centre
  /// @return         L, [n_solid x columns]
  [[nodiscard]] Matrix local(std::span<const DistantMoments> sources, Index columns) const;

 private:
  struct Batch;
  /// One product with the quarter turn of every degree.
  void quarter_turn(int degree, bool back, const double* from, double* to) const;
  /// Moments about a centre on the axis to coefficients about the origin, both over powers of the distance.
  void along_axis(int degree, double* values, double* spare) const;
  template <int kColumns>
  void add_local(std::span<const DistantMoments> sources, Batch& batch, RowMatrix& sum) const;

  int degree_;
  RotationY quarter_;
  std::vector<RowMatrix> axis_;  ///< of each order m, [degree + 1 − m x degree + 1 − m]
  Vector scale_;                 ///< of R in turnable order
  std::vector<Index> solid_;     ///< where each turnable entry is among the solid harmonics
  std::vector<double> sign_;     ///< of moments in turnable order
};

}  // namespace vehd

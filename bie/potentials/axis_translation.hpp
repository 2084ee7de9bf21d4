#pragma once

#include <span>
#include <vector>

#include "bie/potentials/solid_harmonics.hpp"
#include "bie/sphere/rotation.hpp"

namespace vehd {

/// Moments of sources about their own centre, and the translation to another centre.
struct DistantMoments {
  const RowMatrix* moments;  ///< AxisTranslation::turnable, [n_solid x columns]
  Vector3 offset;            ///< centre of the expansion minus that of the sources
  int degree;                ///< up to which they are translated; best similar for neighbours in a list
};

/// Coefficients L of φ = R(x) L about a centre from moments M of sources about other centres c, φ = Σ M_lm I_lm(x − c).
/// Each translation is rotated onto the z axis, along which orders do not mix, and back: O(degree³), and no matrix per
/// pair. A rotation to any direction is one about z, a quarter turn about y, one about z by the polar angle, and the
/// quarter turn back, so that one product with the same small matrices handles many sources.
/// Accuracy: rounding of the truncated sums (tests/potentials/axis_translation_test.cpp)
/// Source: addition theorem of the solid harmonics, Epton and Dembart 1995; rotations to the axis, White and
/// Head-Gordon 1996
class AxisTranslation {
 public:
  /// @param degree  highest degree of moments and coefficients
  explicit AxisTranslation(int degree);

  /// Moments scaled to orthonormal harmonics, which rotations leave orthonormal; per degree cosines, then sines.
  /// @param moments  of all degrees, [n_solid x columns], see `moments`
  [[nodiscard]] RowMatrix turnable(const Matrix& moments) const;

  /// Coefficients L summed over all sources, in their order.
  /// @param columns  1; or 4: charges A_1, A_2, A_3 and B = Σ (y − centre of its sources)·A(y), which is converted to
  ///     the new centre
  /// @return         L, [n_solid x columns]
  [[nodiscard]] Matrix local(std::span<const DistantMoments> sources, Index columns) const;

 private:
  struct Batch;
  /// Rotates every degree by the quarter turn.
  void quarter_turn(int degree, bool back, const double* from, double* to) const;
  /// Translates moments about a centre on the axis to coefficients about the origin, both over powers of the distance.
  void along_axis(int degree, double* values, double* spare) const;
  template <int kColumns>
  void add_local(std::span<const DistantMoments> sources, Batch& batch, RowMatrix& sum) const;

  int degree_;
  RotationY quarter_;
  std::vector<RowMatrix> axis_;  ///< of each order m, [degree + 1 − m x degree + 1 − m]
  Vector scale_;                 ///< of R in turnable order
  std::vector<Index> solid_;     ///< index of each turnable entry among the solid harmonics
  std::vector<double> sign_;     ///< of moments in turnable order
};

}  // namespace vehd

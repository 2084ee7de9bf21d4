#pragma once

#include <memory>

#include "bie/sphere/grid.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Fields with covariant derivatives on the unit sphere in the frame (e_θ, e_φ); each [n_points x n_fields].
/// d22 = f_φφ/sin²θ + cot θ f_θ and so on: every entry is smooth at the poles and computed without dividing by sin θ.
struct SphereDerivatives {
  Matrix value, d1, d2, d11, d12, d22;
};

/// Spherical-harmonic transform between coefficients of degree ≤ order and a grid, as products of small matrices over
/// one octant. Immutable after construction; calls are thread safe. Copies share their tables. Cost O(order² n_theta)
/// per field.
///
/// Accuracy: rounding; round trips to 2e-13 up to degree 64 (tests/sphere/transform_test.cpp)
///
/// Source: paper Eqs. (16), (17), (21)
class SphereTransform {
 public:
  /// @throws ShapeError if grid.order < order or grid.n_phi < 2 order + 2
  SphereTransform(int order, SphereGrid grid);
  /// For fields with Fourier modes |m| ≤ azimuthal_order in φ: coefficients of larger |m| are not read, and analysis
  /// returns zeros for them; n_phi ≥ 2 azimuthal_order + 2 longitudes suffice.
  SphereTransform(int order, SphereGrid grid, int azimuthal_order);

  /// Degree p of the coefficients.
  [[nodiscard]] int order() const;
  /// Largest |m| of the coefficients that are read and computed.
  [[nodiscard]] int azimuthal_order() const;
  /// The grid of the values.
  [[nodiscard]] const SphereGrid& grid() const;

  /// Values [n_points x F] from coefficients [(order+1)² x F].
  [[nodiscard]] Matrix synthesize(const Matrix& coefficients) const;
  /// Value and first derivatives, each [n_points x F], from coefficients [(order+1)² x F]; d11, d12, d22 stay empty.
  [[nodiscard]] SphereDerivatives synthesize_gradient(const Matrix& coefficients) const;
  /// First derivatives only, each [n_points x F], from coefficients [(order+1)² x F].
  [[nodiscard]] SphereDerivatives synthesize_first_derivatives(const Matrix& coefficients) const;
  /// First and second derivatives without the value, each [n_points x F], from coefficients [(order+1)² x F].
  [[nodiscard]] SphereDerivatives synthesize_derivatives(const Matrix& coefficients) const;
  /// Value, first and second derivatives, each [n_points x F], from coefficients [(order+1)² x F].
  [[nodiscard]] SphereDerivatives synthesize_hessian(const Matrix& coefficients) const;
  /// Coefficients [(order+1)² x F] of degree ≤ order from values [n_points x F] by Gauss quadrature; exact for fields
  /// of degree ≤ 2 grid.order + 1 − order.
  [[nodiscard]] Matrix analyze(const Matrix& values) const;

 private:
  struct Tables;
  std::shared_ptr<const Tables> tables_;
};

}  // namespace vehd

#pragma once

#include <Eigen/LU>
#include <vector>

#include "bie/geometry/surface.hpp"
#include "bie/potentials/layer_operators.hpp"
#include "bie/sphere/symmetry.hpp"

namespace vehd {

struct EffectRow;

/// Fluids of different viscosity inside and outside.
struct ViscosityContrastParameters {
  double ratio = 1.0;  ///< μ_i/μ_e ≥ 0
};

/// Velocity map of one frozen membrane between two fluids. Green's identities on either side give
///
///   (1 + ratio)/2 v − (1 − ratio) D[v] = w,   w = v_∞ + S[f]/μ_e,
///
/// with the principal value of the Stokes double layer D (stokes_double_kernel) and f the force on the fluid; w is the
/// velocity for two fluids of viscosity μ_e. Two properties of the continuous operator are imposed on the discrete one,
/// because its errors would otherwise be multiplied by ratio or by 1/ratio:
/// - D[a + b × x] = −½(a + b × x). These motions remain as ratio → ∞, while all others vanish.
/// - ∫ n·(½ − D)[v] dA = 0 for any v. So v has no flux if w has none, and the expansion of the inside, which an
///   incompressible fluid forbids at any viscosity, stays regular as ratio → 0: the flux of w, a discretisation error,
///   is not amplified.
/// The map is a dense LU factorisation for the unknowns that symmetry leaves, computed once per shape.
/// Accuracy: spectral at every ratio: closed spectrum of the sphere to 1e-11, a flow common to both fluids to 1e-5 at p
/// = 18, rigid motions to 1e-12 (tests/physics/viscosity_contrast_test.cpp)
/// Source: Pozrikidis 1992
class ViscosityContrast {
 public:
  /// @param fine         degree p ↔ upsampled grid
  /// @param surface      on the upsampled grid
  /// @param double_layer Stokes double layer on the surface, used only here
  /// @param subspace     symmetries of the surface and the velocities, v(g s) = g v(s); other parts of w are ignored
  /// @throws InputError unless ratio ≥ 0
  ViscosityContrast(const ViscosityContrastParameters& parameters, const SphereTransform& fine, const Surface& surface,
                    const StokesOperator& double_layer, const SymmetrySubspace& subspace);

  /// v from w, coefficients [n_coefficients x 3]. @throws ShapeError
  [[nodiscard]] Matrix velocity(const Matrix& equal_viscosity_velocity) const;

 private:
  Index n_coefficients_;
  std::vector<Index> unknowns_;  ///< entries of the column-major [n_coefficients x 3] that can be nonzero
  double largest_;               ///< max(1, ratio), the scale of the factor
  Matrix rigid_;                 ///< orthonormal basis of the rigid motions, [unknowns x at most 6]
  Eigen::PartialPivLU<Matrix> factor_;
};

/// Eigenvalues of v ↦ (1 + ratio)/2 v − (1 − ratio) D[v] on a sphere for the vector harmonics V = ∇Y − (n+1) Y r̂,
/// W = ∇Y + n Y r̂, X = r̂ × ∇Y of degree n, where D has
///   3/(2(2n+1)(2n+3)), −3/(2(2n−1)(2n+1)), −3/(2(2n+1)).
/// Accuracy: closed form; the assembled map agrees to 1e-11 (tests/physics/viscosity_contrast_test.cpp)
struct ContrastSpectrum {
  double v, w, x;
};

/// At n = 0 there is only V, the expansion: its entry is max(1, ratio), see ViscosityContrast; the others are 1.
ContrastSpectrum contrast_spectrum(double ratio, int n);

EffectRow viscosity_contrast_row();

}  // namespace vehd

#include "bie/physics/effects/viscosity_contrast.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/model.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

constexpr const char* kViscosityContrast = "viscosity contrast";

/// Orthonormal basis of the translations and rotations, restricted to the unknowns.
Matrix rigid_motions(const Matrix& position, double radius, const std::vector<Index>& entries) {
  Matrix centred = position / radius;
  centred.row(0).setZero();
  Matrix motions(static_cast<Index>(entries.size()), 6);
  for (int axis = 0; axis < 3; ++axis) {
    Matrix translation = Matrix::Zero(position.rows(), 3);
    translation(0, axis) = 1.0;
    Matrix rotation = Matrix::Zero(position.rows(), 3);
    rotation.col((axis + 1) % 3) = -centred.col((axis + 2) % 3);
    rotation.col((axis + 2) % 3) = centred.col((axis + 1) % 3);
    motions.col(axis) = translation.reshaped()(entries);
    motions.col(axis + 3) = rotation.reshaped()(entries);
  }
  // Motions that the symmetry excludes are zero up to rounding.
  Eigen::ColPivHouseholderQR<Matrix> factor;
  factor.setThreshold(1e-9);
  factor.compute(motions);
  // With no columns Eigen would offset a null pointer.
  if (factor.rank() == 0) return Matrix(motions.rows(), 0);
  return factor.householderQ() * Matrix::Identity(motions.rows(), factor.rank());
}

}  // namespace

ViscosityContrast::ViscosityContrast(const ViscosityContrastParameters& parameters, const SphereTransform& fine,
                                     const Surface& surface, const StokesOperator& double_layer,
                                     const SymmetrySubspace& subspace)
    : n_coefficients_(n_coefficients(fine.order())), largest_(std::max(1.0, parameters.ratio)) {
  const double ratio = parameters.ratio;
  if (!(ratio >= 0.0)) throw InputError(fmt::format("viscosity ratio is {} but must not be negative", ratio));
  unknowns_ = subspace.vectors();
  // From the area, because a square root scales exactly with powers of two and a cube root does not.
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  rigid_ = rigid_motions(fine.analyze(surface.position), radius, unknowns_);
  // Truncated to degree p, as v is: its product with the coefficients of v is the flux of v.
  const Matrix area_vector = fine.analyze(surface.area_element.asDiagonal() * surface.normal);
  const Vector flux = Vector(area_vector.reshaped()(unknowns_)).normalized();

  Matrix system = -double_layer.between(n_coefficients_, unknowns_);  // ½ − D
  system.diagonal().array() += 0.5;
  const Matrix defect = rigid_ - system * rigid_;
  system.noalias() += defect * rigid_.transpose();
  const Vector outflow = system.transpose() * flux;
  system.noalias() -= flux * outflow.transpose();
  // The operator is ratio + (1 − ratio)(½ − D). Below ratio 1 its eigenvalue `ratio` of the expansion is replaced by 1;
  // above, its eigenvalue 1 of the rigid motions is replaced by `ratio` (undone in `velocity`). Divided by max(1,
  // ratio), the matrix is then well conditioned at any ratio.
  if (ratio > 1.0) {
    system.noalias() -= rigid_ * rigid_.transpose();
    system *= -(1.0 - 1.0 / ratio);
  } else {
    system.noalias() += flux * flux.transpose();
    system.diagonal().array() -= 1.0;
    system *= 1.0 - ratio;
  }
  system.diagonal().array() += 1.0;
  factor_.compute(system);
}

Matrix ViscosityContrast::velocity(const Matrix& equal_viscosity_velocity) const {
  require_size("velocity", equal_viscosity_velocity.rows(), n_coefficients_);
  require_size("velocity (Cartesian components)", equal_viscosity_velocity.cols(), 3);
  const Vector driven = equal_viscosity_velocity.reshaped()(unknowns_);
  Vector solution = factor_.solve(driven);
  const double faded = 1.0 / largest_;
  const Vector kept = rigid_.transpose() * solution;
  solution *= faded;
  solution.noalias() += (1.0 - faded) * (rigid_ * kept);
  Matrix result = Matrix::Zero(n_coefficients_, 3);
  result.reshaped()(unknowns_) = solution;
  return result;
}

ContrastSpectrum contrast_spectrum(double ratio, int n) {
  if (n == 0) return {std::max(1.0, ratio), 1.0, 1.0};
  const double mean = 0.5 * (1.0 + ratio);
  const double contrast = 1.5 * (1.0 - ratio) / (2.0 * n + 1.0);
  return {mean - contrast / (2.0 * n + 3.0), mean + contrast / (2.0 * n - 1.0), mean + contrast};
}

EffectRow viscosity_contrast_row() {
  return {kViscosityContrast,
          [](const Model& model, const VesicleModel& vesicle) -> MadeEffect {
            if (!model.mobile || vesicle.viscosity_ratio == 1.0) return nullptr;
            return described([] {
              return EffectDescription{kViscosityContrast,
                                       "(1 + ratio)/2 v - (1 - ratio) D[v] = v_inf + S[f]/mu in place of Eq. (5)",
                                       {{&LayerSelection::stokes_double, "D of the velocity map"}},
                                       {}};
            });
          },
          [](Model&, VesicleModel& vesicle) { vesicle.viscosity_ratio = 1.0; }};
}

}  // namespace vehd

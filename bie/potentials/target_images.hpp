#pragma once

#include <optional>
#include <vector>

#include "bie/potentials/kernel_columns.hpp"
#include "bie/sphere/reflection.hpp"

namespace vehd {

/// Coefficients of |m| ≤ azimuthal_order in order-major order: m = 0, then cosines and sines of m = 1, 2, ...
struct ActiveCoefficients {
  std::vector<int> n, m;
  std::vector<Index> position;  ///< among the active ones in coefficient order
  std::vector<Index> indices;   ///< coefficient_index of each position; empty if all are active

  /// @param azimuthal_order  at most `order`
  ActiveCoefficients(int order, int azimuthal_order);

  [[nodiscard]] Index count() const { return static_cast<Index>(n.size()); }
};

/// Maps the kernel row of a target to that of the target rotated by R, the rotation by the angle α about z, on a
/// surface that is invariant under R: cosine and sine of one m mix by the angle mα, Stokes blocks become R K Rᵀ.
/// Accuracy: rounding; operators agree with those without images to 1e-12 (tests/potentials/target_images_test.cpp)
class RowRotation {
 public:
  /// @param angle   α in radians
  /// @param active  with a full set of degrees for every order
  RowRotation(double angle, const KernelColumns& kernels, const ActiveCoefficients& active);

  /// @param row  [kernels * active coefficients]
  void apply(Eigen::Ref<Eigen::RowVectorXd> row) const;

 private:
  double cosine_, sine_;  ///< of α
  std::vector<int> stokes_;
  Index n_active_, n_kernels_;
  int order_;
  Vector cosines_, sines_;  ///< of mα
};

/// Maps g with x(g s) = g x(s): reflections, closed under composition, and rotations about z by multiples of 2π/fold.
struct SurfaceMaps {
  const std::vector<Reflection>& reflections;
  int fold = 1;
};

/// Completes the rows of targets from those of their images on a symmetric surface. Under a reflection a row over
/// coefficients changes sign with the parity of each harmonic and, in the Stokes blocks, with the components i and j;
/// for rotations see RowRotation.
/// Accuracy: rounding; operators agree with those without images to 1e-12 (tests/potentials/target_images_test.cpp)
class TargetImages {
 public:
  /// @param n_phi  even, and a multiple of the fold
  TargetImages(const SurfaceMaps& maps, const KernelColumns& kernels, const ActiveCoefficients& active, int n_phi);

  /// Azimuths whose rows must be computed.
  [[nodiscard]] const std::vector<int>& originals() const { return originals_; }
  /// Number of azimuths that each original represents.
  [[nodiscard]] std::vector<int> multiplicities() const;
  /// Whether the only original lies at azimuth 0, in a plane y = 0 of symmetry of the surface.
  [[nodiscard]] bool in_mirror() const { return in_mirror_; }
  /// A reflection that maps a latitude to the other hemisphere, if there is one.
  [[nodiscard]] const std::optional<Reflection>& flip() const { return flip_; }
  /// Signs of a row under that reflection.
  [[nodiscard]] const Eigen::RowVectorXd& flip_signs() const { return flip_signs_; }

  /// Completes the rows of one latitude, [n_phi x row], from those of the originals.
  void fill(Eigen::Ref<RowMatrix> rows) const;

 private:
  /// An azimuth as the image of another: reflected first, then rotated.
  struct Image {
    int original = -1;  ///< −1 for an original
    int reflection = 0;
    int rotations = 0;
  };
  std::vector<Image> images_;
  std::vector<int> originals_;
  std::vector<Eigen::RowVectorXd> signs_;  ///< of each reflection that keeps the latitude, the identity first
  std::vector<RowRotation> rotations_;     ///< by 2π/fold, 4π/fold, ...
  bool in_mirror_ = false;
  std::optional<Reflection> flip_;
  Eigen::RowVectorXd flip_signs_;
};

}  // namespace vehd

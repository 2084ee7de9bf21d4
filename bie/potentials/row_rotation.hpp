#pragma once

#include "bie/potentials/kernel_columns.hpp"

namespace vehd {

struct ActiveCoefficients;

/// How the kernel row of a target follows from that of the target before a rotation R by the angle α about z, where the
/// surface is its own image under R: cosine and sine of one m mix by the angle mα, Stokes blocks become R K Rᵀ.
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

}  // namespace vehd

#pragma once

#include <vector>

#include "bie/potentials/graded_rule.hpp"
#include "bie/potentials/layer_sums.hpp"
#include "bie/sphere/rotation.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Fields on the membrane in the frame whose north pole is a given direction.
/// Accuracy: rounding of the rotation
class TargetFrame {
 public:
  /// @param fields  must outlive the frame
  /// @param theta, phi  direction of the pole
  TargetFrame(const LayerFields& fields, double theta, double phi);

  /// Values of the fields at the pole.
  [[nodiscard]] const Eigen::RowVectorXd& pole() const { return pole_; }

  /// Fields at the nodes of a rule, [n_phi x filled_up(columns * n_theta)]: in the row of an azimuth, column c of
  /// NodeColumns at node i is entry c * n_theta + i. Positions and densities of double layers are relative to those at
  /// the pole; densities of single layers are J f. Rows are padded with zeros.
  [[nodiscard]] RowMatrix nodes(const GradedRule& rule) const;
  /// Rows over coefficients in the frame of the pole converted to rows over the original coefficients, by the adjoint
  /// of the rotation.
  /// @param rotated  per m [2 columns x (order + 1 − m), filled up], cosines and sines
  /// @return         [columns x n_coefficients]
  [[nodiscard]] RowMatrix rotated_back(const std::vector<RowMatrix>& rotated) const;

  /// Sums over the nodes of a rule for a target at `offset` from the position of the pole. The double layers are those
  /// of f − f(pole); the caller adds the rest of D.
  [[nodiscard]] LayersAt integrate(const GradedRule& rule, const Vector3& offset) const;

 private:
  /// Amplitudes of cos mψ and sin mψ on the circles of the rule, [2 order + 1 x filled_up(columns * n_theta)].
  [[nodiscard]] RowMatrix amplitudes(const GradedRule& rule) const;

  const LayerFields& fields_;
  int order_;
  Index n_fields_;
  Vector azimuth_cosine_, azimuth_sine_;  ///< of mφ, m = 0..order
  RotationY rotation_;
  std::vector<Matrix> rotated_;  ///< per m [(order + 1 − m) x 2 n_fields], cosines and sines
  Eigen::RowVectorXd pole_;
};

}  // namespace vehd

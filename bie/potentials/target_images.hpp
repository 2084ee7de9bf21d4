#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "bie/potentials/kernel_columns.hpp"
#include "bie/sphere/reflection.hpp"

namespace vehd {

/// Coefficients of |m| ≤ azimuthal_order in order-major order: m = 0, then cosines and sines of m = 1, 2, ...
struct ActiveCoefficients {
  std::vector<int> n, m;
  std::vector<Index> position;  ///< among the active ones in coefficient order
  std::vector<Index> indices;   ///< coefficient_index of each position; empty if all are active

  ActiveCoefficients(int order, int azimuthal_order);

  [[nodiscard]] Index count() const { return static_cast<Index>(n.size()); }
};

/// How the rows of one target follow from those of another when the surface is its own mirror image: a row over
/// coefficients changes sign with the parity of each harmonic and, in the Stokes blocks, with the components i and j.
class TargetImages {
 public:
  TargetImages(const std::vector<Reflection>& reflections, const KernelColumns& kernels,
               const ActiveCoefficients& active, int n_phi);

  /// Azimuths whose rows have to be computed.
  [[nodiscard]] const std::vector<int>& originals() const { return originals_; }
  /// The reflection that takes a latitude to the other hemisphere, if there is one.
  [[nodiscard]] const std::optional<Reflection>& flip() const { return flip_; }
  /// Signs of a row under that reflection.
  [[nodiscard]] const Eigen::RowVectorXd& flip_signs() const { return flip_signs_; }

  /// Completes the rows of one latitude, [n_phi x row], from those of the originals.
  void fill(Eigen::Ref<RowMatrix> rows) const;

 private:
  std::vector<std::pair<int, int>> image_of_;  ///< original azimuth and reflection, −1 for an original
  std::vector<int> originals_;
  std::vector<Eigen::RowVectorXd> signs_;
  std::optional<Reflection> flip_;
  Eigen::RowVectorXd flip_signs_;
};

}  // namespace vehd

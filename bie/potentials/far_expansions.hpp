#pragma once

#include <cstddef>
#include <vector>

#include "bie/potentials/axis_translation.hpp"
#include "bie/potentials/near_rows.hpp"
#include "bie/potentials/smooth_grid.hpp"
#include "bie/potentials/solid_harmonics.hpp"
#include "bie/support/ranks/partition.hpp"

namespace vehd {

/// One of many membranes, with the points on it at which the layers of the others are evaluated.
struct ExpandedMembrane {
  Matrix position;         ///< coefficients, [n_coefficients x 3]
  Matrix points, normals;  ///< of the targets, [n_targets x 3]; normals of any length
};

/// Layers of many membranes at points of others that are far from them. The moments of each membrane about its centre
/// are translated to local coefficients about the centres of the others, which give the values there. The degree of
/// every pair follows from its distance.
/// Accuracy: the tolerance relative to the potential of the density at the distance of the centre; agrees with direct
/// sums to 1e-9 (tests/potentials/far_expansions_test.cpp)
/// Source: Epton and Dembart 1995; Stokes layers as four harmonic functions, Tornberg and Greengard 2008
class FarExpansions {
 public:
  /// @param tolerance  relative, below 1
  /// @param partition     membranes whose moments and values this rank computes; collective, as are all sums
  FarExpansions(const std::vector<ExpandedMembrane>& membranes, double tolerance, SharedTransforms& transforms,
                Partition partition = {});

  /// Whether the sums at `target` include the layers of `source`.
  [[nodiscard]] bool is_far(std::size_t target, std::size_t source) const;
  /// Number of targets in all far pairs of the membranes of this rank.
  [[nodiscard]] Index n_targets() const;

  /// For each membrane of this rank, a layer at its points summed over all membranes that are far from it.
  /// @param densities  see PairLayer; only those of this rank's membranes are read, empty ones count as zero
  /// @return           [n_targets x 1], of a Stokes layer [n_targets x 3]
  [[nodiscard]] std::vector<Matrix> apply(PairLayer layer, const std::vector<Matrix>& densities) const;

 private:
  /// Lengths are divided by scale_. Only the first three members are set for membranes of other ranks.
  struct MembraneExpansion {
    Vector3 centre;
    double radius;
    SphereTransform nodes;
    Vector weight;
    Matrix from_centre, area_vectors;  ///< of the nodes
    MomentSums sums;                   ///< over the nodes
    Matrix target_from_centre, target_normals, target_regular;
  };
  struct FarSource {
    std::size_t membrane;
    int degree;
  };

  void find_places(const std::vector<ExpandedMembrane>& membranes, const std::vector<Vector3>& centres,
                   SharedTransforms& transforms);
  [[nodiscard]] MembraneExpansion place_of(const ExpandedMembrane& membrane, const Vector3& centre,
                                           const SphereTransform& nodes) const;
  [[nodiscard]] int degree_of(const MembraneExpansion& a, const MembraneExpansion& b) const;
  [[nodiscard]] Matrix dipole_moments(const MembraneExpansion& place, const std::vector<Matrix>& components) const;
  /// @param moments     of each membrane, [n_solid x columns] or empty
  /// @param is_stokes   four columns, the last of which refers to the centre of its source
  [[nodiscard]] std::vector<Matrix> local(const std::vector<Matrix>& moments, bool is_stokes) const;
  /// Moments of one membrane.
  [[nodiscard]] Matrix moments_of(PairLayer layer, const MembraneExpansion& place, const Matrix& density) const;
  /// A layer without its prefactor at the targets of one membrane, from local coefficients.
  [[nodiscard]] Matrix values_of(PairLayer layer, const MembraneExpansion& place, const Matrix& coefficients) const;

  Partition partition_;
  double tolerance_, scale_ = 1.0;
  AxisTranslation translation_;
  std::vector<Eigen::SparseMatrix<double>> derivative_;
  std::vector<MembraneExpansion> places_;
  std::vector<std::vector<FarSource>> far_from_;  ///< for each membrane those far from it, by degree
};

}  // namespace vehd

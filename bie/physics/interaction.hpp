#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bie/physics/wall.hpp"
#include "bie/potentials/pair_layers.hpp"
#include "bie/sphere/symmetry.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/ranks/partition.hpp"

namespace vehd {

/// With more membranes than this, multipole expansions evaluate distant pairs; with fewer, sums over the nodes take
/// less time than the moments.
constexpr std::size_t most_summed_membranes = 8;

/// One of several membranes.
struct InteractingMembrane {
  const Matrix& position;        ///< coefficients, [n_coefficients x 3]
  const SphereTransform& nodes;  ///< degree p ↔ nodes where the layers of the others are evaluated
  PairSelection selection;       ///< its own layers that the others need
  Symmetry symmetry{};           ///< of its fields and surroundings: of nodes that it relates only one is evaluated
};

/// Layers of every membrane on all others, as maps from the densities of all to coefficients on each: for membrane a
/// the sum over all b ≠ a. With more than a few membranes, multipole expansions evaluate distant pairs. The maps are
/// assembled once for frozen shapes. An empty density counts as zero. No membrane may enclose or intersect another.
/// With several ranks, each has the layers of its own membranes, needs only their densities and obtains only the
/// results on them; others stay empty. All calls are then collective. The sums have the same bits for any number of
/// ranks.
///
/// Beside a wall each membrane has an image beyond it, which acts on all membranes, including its own. The layers of
/// the image are those of the membrane at mirrored nodes, see wall_images.hpp.
///
/// If membranes with their fields are images of others under a symmetry, nothing is computed for the images: only the
/// densities of the originals are required, and only their results returned.
/// Accuracy: that of PairLayers at the nodes, then truncation to the degree of the target; Green's identity between two
/// shapes without symmetry, nine membranes as the sums of their pairs to 1e-9 (tests/physics/interaction_test.cpp); at
/// a wall two mirrored membranes to 1e-9, Green's identities without slip (tests/physics/wall_test.cpp)
/// Source: paper Eqs. (6), (8), (9) with source and target on different membranes; no_slip_flow
class Interaction {
 public:
  /// A single membrane in unbounded fluid, which this process owns: the interaction is empty.
  Interaction();
  /// @param settings     row_bytes is the memory for all membranes together
  /// @param instruments  counts the targets, as counts() does
  /// @param exchange     images of membranes, as in the partition; with any, at most most_summed_membranes membranes
  /// @param transforms   to be reused; missing ones are made
  /// @param wall         beside the membranes, or none; a membrane at a gap of rounding intersects its image
  /// @throws ConvergenceError if two membranes intersect or are too near for any rule, on the rank of one of them
  Interaction(const std::vector<InteractingMembrane>& membranes, const PairSettings& settings, Instruments& instruments,
              Partition partition = {}, Exchange exchange = {}, SharedTransforms transforms = {},
              const std::optional<Wall>& wall = {});

  ~Interaction();
  Interaction(Interaction&&) noexcept;

  /// Does no membrane act on another one or, through a wall, on itself?
  [[nodiscard]] bool is_empty() const;
  /// Assignment of the membranes to ranks.
  [[nodiscard]] const Partition& partition() const;
  /// Which membranes are images of others.
  [[nodiscard]] const Exchange& exchange() const;
  /// Sends the fields of each rank's membranes to all ranks and maps those of originals to their images: coefficients
  /// of scalars that take the sign of V_m, one per column. Collective.
  template <typename Field>
  void gather_potentials(std::vector<Field>& fields) const {
    partition().gather(fields,
                       [this](const Field& f, std::size_t a) -> Field { return exchange().image(a).potential(f); });
  }
  /// As gather_potentials, for vectors, [n_coefficients x 3]. Collective.
  void gather_vectors(std::vector<Matrix>& fields) const {
    partition().gather(fields, [this](const Matrix& f, std::size_t a) { return exchange().image(a).vector(f); });
  }

  // Each throws std::logic_error for a layer that was not selected, and if the interaction is empty.

  /// J n·∇S[f] from J f, coefficients [n_coefficients] of each membrane: S′ between membranes. Degree 0 is zero: the
  /// layers of others have no flux through a membrane.
  [[nodiscard]] std::vector<Vector> weighted_single_flux(const std::vector<Vector>& weighted) const;
  /// J n·∇D[f] from f, coefficients [n_coefficients] of each: D′ between membranes. Degree 0 is zero as well.
  [[nodiscard]] std::vector<Vector> weighted_double_flux(const std::vector<Vector>& densities) const;
  /// S[f] from J f, coefficients [n_coefficients] of each.
  [[nodiscard]] std::vector<Vector> single_potential(const std::vector<Vector>& weighted) const;
  /// D[f] from f, coefficients [n_coefficients] of each.
  [[nodiscard]] std::vector<Vector> double_potential(const std::vector<Vector>& densities) const;
  /// Stokes single layer at μ = 1 from J f, [n_coefficients x 3] each.
  [[nodiscard]] std::vector<Matrix> stokes_single(const std::vector<Matrix>& weighted) const;
  /// Stokes double layer from v, [n_coefficients x 3] each.
  [[nodiscard]] std::vector<Matrix> stokes_double(const std::vector<Matrix>& velocities) const;

  /// Number of targets of all pairs by method, for the membranes of this rank.
  [[nodiscard]] PairCounts counts() const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace vehd

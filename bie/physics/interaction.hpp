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

/// With more membranes distant pairs are served by multipole expansions: with fewer a sum over the nodes of each other
/// one takes less time than moments of all.
constexpr std::size_t most_summed_membranes = 8;

/// One of several membranes.
struct InteractingMembrane {
  const Matrix& position;        ///< coefficients, [n_coefficients x 3]
  const SphereTransform& nodes;  ///< degree p ↔ where the layers of the others are taken
  PairSelection selection;       ///< its own layers that the others need
  Symmetry symmetry{};           ///< of all that is on it and about it: layers are found at one of the nodes it relates
};

/// Layers of every membrane on all others, as maps from the densities of all to coefficients on each: for membrane a
/// the sum over all b ≠ a. With more than a few membranes distant pairs are served by multipole expansions. Made once
/// for frozen shapes, applied many times; an empty density counts as zero. All membranes are outside one another.
///
/// Of several ranks each has the layers of its own membranes: of densities it needs theirs, and of results it gets
/// theirs, the others stay empty. All calls are collective then. The sums have the same bits for any number of ranks.
///
/// Beside a wall each membrane has an image beyond it, which acts on all membranes, the one itself included; its layers
/// are those of the membrane at mirrored nodes, see wall_images.hpp.
///
/// Where membranes with all that is on them are images of others nothing is computed for the images: of densities it
/// needs those of the originals, and of results it gives theirs.
/// Accuracy: that of PairLayers at the nodes, and what the degree of the target leaves out of the sums; Green's
/// identity between two shapes without symmetry, nine membranes as the sums of their pairs to 1e-9
/// (tests/physics/interaction_test.cpp)
/// Beside a wall two mirrored membranes to 1e-9, Green's identities without slip (tests/physics/wall_test.cpp)
/// Source: paper Eqs. (6), (8), (9) with source and target on different membranes; no_slip_flow
class Interaction {
 public:
  /// One membrane alone in unbounded fluid: the interaction is empty, and this process has the membrane.
  Interaction();
  /// @param settings     memory for rows is that of all
  /// @param instruments  targets of all pairs are counted there, of the membranes of this rank
  /// @param exchange     which membranes are images of others, as the partition has it; most_summed_membranes then
  /// @param transforms   those known already; others are made
  /// @param wall         beside the membranes, or none; at a gap of rounding a membrane meets its image
  /// @throws ConvergenceError if two membranes intersect or are too near for any rule, on the rank of one of them
  Interaction(const std::vector<InteractingMembrane>& membranes, const PairSettings& settings, Instruments& instruments,
              Partition partition = {}, Exchange exchange = {}, SharedTransforms transforms = {},
              const std::optional<Wall>& wall = {});

  ~Interaction();
  Interaction(Interaction&&) noexcept;

  /// Is there no membrane that acts on another one or, by way of a wall, on itself?
  [[nodiscard]] bool is_empty() const;
  /// Which membranes are whose.
  [[nodiscard]] const Partition& partition() const;
  /// Which membranes are images of others.
  [[nodiscard]] const Exchange& exchange() const;
  /// Gives all ranks what each has for its membranes, and images what follows from their originals: coefficients of
  /// scalars with the sign of V_m, each column one of them. Collective.
  template <typename Field>
  void gather_potentials(std::vector<Field>& fields) const {
    partition().gather(fields,
                       [this](const Field& f, std::size_t a) -> Field { return exchange().image(a).potential(f); });
  }
  /// Gathers vectors, [n_coefficients x 3]. Collective.
  void gather_vectors(std::vector<Matrix>& fields) const {
    partition().gather(fields, [this](const Matrix& f, std::size_t a) { return exchange().image(a).vector(f); });
  }

  // Each throws std::logic_error for a layer that was not selected, and where the interaction is empty.

  /// J n·∇S[f] from J f, coefficients [n_coefficients] of each membrane: S′ between membranes. Degree 0 is zero: the
  /// layers of others have no flux through a membrane.
  [[nodiscard]] std::vector<Vector> weighted_single_flux(const std::vector<Vector>& weighted) const;
  /// J n·∇D[f] from f, coefficients [n_coefficients] of each: D′ between membranes, degree 0 likewise.
  [[nodiscard]] std::vector<Vector> weighted_double_flux(const std::vector<Vector>& densities) const;
  /// S[f] from J f, coefficients [n_coefficients] of each.
  [[nodiscard]] std::vector<Vector> single_potential(const std::vector<Vector>& weighted) const;
  /// D[f] from f, coefficients [n_coefficients] of each.
  [[nodiscard]] std::vector<Vector> double_potential(const std::vector<Vector>& densities) const;
  /// Stokes single layer at μ = 1 from J f, [n_coefficients x 3] each.
  [[nodiscard]] std::vector<Matrix> stokes_single(const std::vector<Matrix>& weighted) const;
  /// Stokes double layer from v, [n_coefficients x 3] each.
  [[nodiscard]] std::vector<Matrix> stokes_double(const std::vector<Matrix>& velocities) const;

  /// How many targets of all pairs take which way; of the membranes of this rank.
  [[nodiscard]] PairCounts counts() const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace vehd

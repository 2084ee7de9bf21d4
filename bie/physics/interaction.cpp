#include "bie/physics/interaction.hpp"

#include <fmt/format.h>

#include <optional>

#include "bie/potentials/far_expansions.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Nodes and J n there.
struct TargetNodes {
  Matrix points, area_vectors;
};

TargetNodes target_nodes(const InteractingMembrane& membrane) {
  const SphereDerivatives x = membrane.nodes.synthesize_gradient(membrane.position);
  TargetNodes result{x.value, Matrix(x.value.rows(), 3)};
  for (Index i = 0; i < x.value.rows(); ++i) {
    result.area_vectors.row(i) = Vector3(x.d1.row(i)).cross(Vector3(x.d2.row(i))).transpose();
  }
  return result;
}

/// With fewer membranes a sum over the nodes of each other one takes less time than moments of all.
constexpr std::size_t kFewMembranes = 8;

}  // namespace

struct Interaction::Parts {
  Shares shares;
  std::vector<SphereTransform> targets;        ///< of each membrane
  std::vector<std::vector<std::size_t>> near;  ///< of each membrane the others that its layers serve
  /// Of each membrane of this rank at the nodes of these, one after the other.
  std::vector<std::optional<PairLayers>> layers;
  std::optional<FarExpansions> expansions;  ///< for all others, where there are any

  [[nodiscard]] std::size_t n() const { return targets.size(); }
  /// Those of this rank.
  template <class Body>
  void for_each_membrane(const Body& body) const {
    for_each_member(shares.own(n()), body);
  }

  /// @param layer     of one membrane at the nodes of those that are near to it
  /// @param expanded  of all at those that are far
  template <class Field, class Layer, class Expanded>
  [[nodiscard]] std::vector<Field> sums(const std::vector<Field>& densities, Index components, const Layer& layer,
                                        const Expanded& expanded) const {
    require_size("densities of membranes", static_cast<long>(densities.size()), static_cast<long>(n()));
    std::vector<Matrix> values;
    if (expansions) {
      values = expanded(*expansions, densities);
    } else {
      for (const SphereTransform& nodes : targets) {
        values.emplace_back(Matrix::Zero(nodes.grid().n_points(), components));
      }
    }
    std::vector<Matrix> from(n());
    for_each_membrane([&](std::size_t b) {
      if (densities[b].size() > 0 && !near[b].empty()) from[b] = layer(*layers[b], densities[b]);
    });
    add_near(from, values);
    std::vector<Field> result(n());
    for_each_membrane([&](std::size_t a) { result[a] = targets[a].analyze(values[a]); });
    return result;
  }

  /// Adds what each membrane does to those near to it, in the order of the sources. @param from  of those of this rank
  void add_near(const std::vector<Matrix>& from, std::vector<Matrix>& values) const {
    std::vector<Packing> to(static_cast<std::size_t>(shares.ranks().size()));
    for_each_block(from, [&](std::size_t a, const auto& block) {
      if (!shares.owns(a)) to[static_cast<std::size_t>(shares.owner(a))](a, Matrix(block));
    });
    std::vector<std::string> parcels;
    for (Packing& parcel : to) parcels.push_back(parcel.take());
    parcels = shares.ranks().exchange(parcels);
    for (int rank = 0; rank < shares.ranks().size(); ++rank) {
      if (rank == shares.ranks().rank()) {
        for_each_block(from, [&](std::size_t a, const auto& block) {
          if (shares.owns(a)) values[a] += block;
        });
      }
      Unpacking parcel(parcels[static_cast<std::size_t>(rank)]);
      while (!parcel.is_empty()) {
        std::size_t a = 0;
        Matrix block;
        parcel(a, block);
        values[a] += block;
      }
    }
  }

  /// body(target, values there) for all targets near to all sources, in the order of the sources.
  template <class Body>
  void for_each_block(const std::vector<Matrix>& from, const Body& body) const {
    for (std::size_t b = 0; b < n(); ++b) {
      if (from[b].size() == 0) continue;
      Index first = 0;
      for (const std::size_t a : near[b]) {
        const Index count = targets[a].grid().n_points();
        body(a, from[b].middleRows(first, count));
        first += count;
      }
    }
  }

  template <class Layer, class Expanded>
  [[nodiscard]] std::vector<Vector> fluxes(const std::vector<Vector>& densities, const Layer& layer,
                                           const Expanded& expanded) const {
    std::vector<Vector> result = sums(densities, 1, layer, expanded);
    for (Vector& flux : result) {
      if (flux.size() > 0) flux[0] = 0.0;
    }
    return result;
  }
};

Interaction::Interaction(const std::vector<InteractingMembrane>& membranes, const PairSettings& settings,
                         Instruments& instruments, Shares shares) {
  auto parts = std::make_unique<Parts>();
  parts->shares = std::move(shares);
  SharedTransforms transforms;
  PairSettings of_one = settings;
  of_one.row_bytes /= static_cast<double>(membranes.size());
  std::vector<TargetNodes> nodes;
  for (const InteractingMembrane& membrane : membranes) {
    parts->targets.push_back(membrane.nodes);
    nodes.push_back(target_nodes(membrane));
  }
  if (membranes.size() > kFewMembranes) {
    const auto timer = instruments.time("pair layers");
    std::vector<ExpandedMembrane> expanded;
    for (std::size_t a = 0; a < membranes.size(); ++a) {
      expanded.push_back({membranes[a].position, nodes[a].points, nodes[a].area_vectors});
    }
    parts->expansions.emplace(expanded, settings.tolerance, transforms, parts->shares);
  }
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    std::vector<std::size_t>& near = parts->near.emplace_back();
    std::optional<PairLayers>& layers = parts->layers.emplace_back();
    if (!parts->shares.owns(b)) continue;
    Index n_near = 0;
    for (std::size_t a = 0; a < membranes.size(); ++a) {
      if (a == b || (parts->expansions && parts->expansions->is_far(a, b))) continue;
      near.push_back(a);
      n_near += nodes[a].points.rows();
    }
    TargetNodes others{Matrix(n_near, 3), Matrix(n_near, 3)};
    Index first = 0;
    for (const std::size_t a : near) {
      others.points.middleRows(first, nodes[a].points.rows()) = nodes[a].points;
      others.area_vectors.middleRows(first, nodes[a].points.rows()) = nodes[a].area_vectors;
      first += nodes[a].points.rows();
    }
    try {
      layers.emplace(membranes[b].position, others.points, others.area_vectors, membranes[b].selection, of_one,
                     transforms, instruments);
    } catch (const ConvergenceError& error) {
      throw ConvergenceError(
          fmt::format("membrane {} of {} and another one: {}", b + 1, membranes.size(), error.what()));
    }
  }
  parts_ = std::move(parts);
  const PairCounts all = counts();
  instruments.count_pair_targets("near", static_cast<std::uint64_t>(all.near));
  instruments.count_pair_targets("far", static_cast<std::uint64_t>(all.far));
  instruments.count_pair_targets("expanded", static_cast<std::uint64_t>(all.expanded));
}

Interaction::~Interaction() = default;
Interaction::Interaction(Interaction&&) noexcept = default;

std::size_t Interaction::n_membranes() const { return parts_->n(); }

const Shares& Interaction::shares() const { return parts_->shares; }

std::vector<Vector> Interaction::weighted_single_flux(const std::vector<Vector>& weighted) const {
  return parts_->fluxes(
      weighted, [](const PairLayers& layers, const Vector& f) { return layers.laplace_single_normal(f); },
      [](const FarExpansions& far, const std::vector<Vector>& f) { return far.laplace_single_normal(f); });
}

std::vector<Vector> Interaction::weighted_double_flux(const std::vector<Vector>& densities) const {
  return parts_->fluxes(
      densities, [](const PairLayers& layers, const Vector& f) { return layers.laplace_double_normal(f); },
      [](const FarExpansions& far, const std::vector<Vector>& f) { return far.laplace_double_normal(f); });
}

std::vector<Vector> Interaction::single_potential(const std::vector<Vector>& weighted) const {
  return parts_->sums(
      weighted, 1, [](const PairLayers& layers, const Vector& f) { return layers.laplace_single(f); },
      [](const FarExpansions& far, const std::vector<Vector>& f) { return far.laplace_single(f); });
}

std::vector<Vector> Interaction::double_potential(const std::vector<Vector>& densities) const {
  return parts_->sums(
      densities, 1, [](const PairLayers& layers, const Vector& f) { return layers.laplace_double(f); },
      [](const FarExpansions& far, const std::vector<Vector>& f) { return far.laplace_double(f); });
}

std::vector<Matrix> Interaction::stokes_single(const std::vector<Matrix>& weighted) const {
  return parts_->sums(
      weighted, 3, [](const PairLayers& layers, const Matrix& f) { return layers.stokes_single(f); },
      [](const FarExpansions& far, const std::vector<Matrix>& f) { return far.stokes_single(f); });
}

std::vector<Matrix> Interaction::stokes_double(const std::vector<Matrix>& velocities) const {
  return parts_->sums(
      velocities, 3, [](const PairLayers& layers, const Matrix& f) { return layers.stokes_double(f); },
      [](const FarExpansions& far, const std::vector<Matrix>& f) { return far.stokes_double(f); });
}

PairCounts Interaction::counts() const {
  PairCounts all;
  for (const std::optional<PairLayers>& layers : parts_->layers) {
    if (!layers) continue;
    all.far += layers->counts().far;
    all.near += layers->counts().near;
    all.far_nodes += layers->counts().far_nodes;
  }
  if (parts_->expansions) all.expanded = parts_->expansions->n_targets();
  return all;
}

}  // namespace vehd

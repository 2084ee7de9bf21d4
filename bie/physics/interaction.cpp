#include "bie/physics/interaction.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "bie/physics/wall_images.hpp"
#include "bie/potentials/far_expansions.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Nodes of a membrane and J n there.
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

/// Sets of nodes that symmetries map to one another: values are computed at one node of each set, its original.
class NodeImages {
 public:
  NodeImages(const SphereGrid& grid, const Symmetry& symmetry) : images_(static_cast<std::size_t>(grid.n_points())) {
    const int fold = symmetry.axisymmetric ? grid.n_phi : symmetry.fold;
    const auto image_of = [&](Index node, const Reflection& g, int turn) {
      const Index latitude = node / grid.n_phi;
      const int azimuth = g.azimuth(static_cast<int>(node % grid.n_phi), grid.n_phi) + turn * (grid.n_phi / fold);
      return (g.z > 0 ? latitude : grid.n_theta - 1 - latitude) * grid.n_phi + azimuth % grid.n_phi;
    };
    maps_.push_back({Matrix3::Identity(), 1.0});
    for (Index node = 0; node < grid.n_points(); ++node) {
      if (images_[static_cast<std::size_t>(node)].original >= 0) continue;
      const Index original = std::ssize(originals_);
      originals_.push_back(node);
      images_[static_cast<std::size_t>(node)] = {original, 0};
      for (std::size_t g = 0; g < symmetry.reflections.size(); ++g) {
        for (int turn = 0; turn < fold; ++turn) {
          Image& image = images_[static_cast<std::size_t>(image_of(node, symmetry.reflections[g], turn))];
          if (image.original < 0) image = {original, 1 + g * static_cast<std::size_t>(fold) + turn};
        }
      }
    }
    for (std::size_t g = 0; g < symmetry.reflections.size(); ++g) {
      for (int turn = 0; turn < fold; ++turn) {
        maps_.push_back(
            {Isometry{symmetry.reflections[g], turn, fold}.matrix(), static_cast<double>(symmetry.potential_signs[g])});
      }
    }
  }

  [[nodiscard]] Index n_originals() const { return std::ssize(originals_); }
  [[nodiscard]] TargetNodes originals(const TargetNodes& all) const {
    return {all.points(originals_, Eigen::all), all.area_vectors(originals_, Eigen::all)};
  }
  /// Values of a potential, [n x 1], or of a flow, [n x 3], at all nodes from those at the originals.
  [[nodiscard]] Matrix at_all(const Matrix& values) const {
    if (originals_.size() == images_.size()) return values;
    Matrix result(std::ssize(images_), values.cols());
    for (Index node = 0; node < result.rows(); ++node) {
      const auto& [original, number] = images_[static_cast<std::size_t>(node)];
      const Map& map = maps_[number];
      if (values.cols() == 1) {
        result(node, 0) = map.potential_sign * values(original, 0);
      } else {
        result.row(node) = values.row(original) * map.of_vectors.transpose();
      }
    }
    return result;
  }

 private:
  struct Map {
    Matrix3 of_vectors;
    double potential_sign;
  };
  struct Image {
    Index original = -1;  ///< index among the originals
    std::size_t map = 0;
  };
  std::vector<Map> maps_;  ///< the identity first
  std::vector<Image> images_;
  std::vector<Index> originals_;
};

/// Pair that uses the values of a layer at some nodes: as they are if `source` has the layer; otherwise `source` is an
/// image of the membrane that has it, and the values are mapped to `target`.
struct Use {
  std::size_t target, source;
};

/// Nodes of the membrane `at` near to a source, with the pairs that use the values there.
struct NearNodes {
  std::size_t at;
  std::vector<Use> uses;
};

/// Layers of all membranes at nodes that are near to them.
struct NearLayers {
  std::vector<std::vector<NearNodes>> near;  ///< for each membrane, the nodes at which its layers are evaluated
  /// Layers of each membrane of this rank at these nodes, one set after the other; absent if there are no nodes.
  std::vector<std::optional<PairLayers>> layers;
};

/// Mirror images of points and area vectors.
TargetNodes mirrored(const Wall& wall, const TargetNodes& nodes) {
  return {mirrored(wall, nodes.points), nodes.area_vectors * wall.mirror()};
}

}  // namespace

struct Interaction::Parts {
  Partition partition;
  Exchange exchange;
  std::vector<SphereTransform> targets;     ///< to the nodes of each membrane
  std::vector<NodeImages> images;           ///< of its nodes; layers are evaluated at their originals
  NearLayers direct;                        ///< on other membranes
  std::optional<FarExpansions> expansions;  ///< for the pairs not in `direct`, if there are any
  std::optional<Wall> wall;
  NearLayers of_images;  ///< at mirrored nodes of all, for the images in the wall

  [[nodiscard]] std::size_t n() const { return targets.size(); }
  /// Calls body(a) for each membrane a of this rank.
  template <class Body>
  void for_each_membrane(const Body& body) const {
    for_each_member(partition.local_indices(n()), body);
  }

  /// Sum of a layer over all membranes, on each membrane of this rank.
  template <class Field>
  [[nodiscard]] std::vector<Field> sums(PairLayer layer, const std::vector<Field>& densities) const {
    require_size("densities of membranes", static_cast<long>(densities.size()), static_cast<long>(n()));
    std::vector<Matrix> values;
    if (expansions) {
      values = expansions->apply(layer, std::vector<Matrix>(densities.begin(), densities.end()));
    } else {
      for (const NodeImages& nodes : images) {
        values.emplace_back(Matrix::Zero(nodes.n_originals(), is_stokes(layer) ? 3 : 1));
      }
    }
    std::vector<Matrix> by_exchange(n());
    add_near(direct, near_values(direct, layer, densities), values, by_exchange);
    if (wall && has_image(*wall, layer)) {
      std::vector<Matrix> from = near_values(of_images, layer_of_image(*wall, layer), densities);
      for (Matrix& of_one : from) of_one = mirrored_back(*wall, layer, of_one);
      add_near(of_images, from, values, by_exchange);
    }
    std::vector<Field> result(n());
    for_each_membrane([&](std::size_t a) {
      result[a] = analyzed(a, values[a]);
      if (by_exchange[a].size() > 0) result[a] += by_exchange[a];
    });
    return result;
  }

  /// Coefficients on a membrane of values at the originals of its nodes.
  [[nodiscard]] Matrix analyzed(std::size_t a, const Matrix& values) const {
    return targets[a].analyze(images[a].at_all(values));
  }

  /// Layer of each membrane of this rank at the nodes near to it; empty if its density is.
  template <class Field>
  [[nodiscard]] std::vector<Matrix> near_values(const NearLayers& near, PairLayer layer,
                                                const std::vector<Field>& densities) const {
    std::vector<Matrix> from(n());
    for_each_membrane([&](std::size_t b) {
      if (densities[b].size() > 0 && near.layers[b]) from[b] = near.layers[b]->apply(layer, densities[b]);
    });
    return from;
  }

  /// Adds the layer of each membrane to those near to it, in the order of the sources.
  /// @param from         near_values of the membranes of this rank
  /// @param values       sums at nodes of the targets
  /// @param by_exchange  sums, in coefficients, of the layers of membranes that are images of others
  void add_near(const NearLayers& near, const std::vector<Matrix>& from, std::vector<Matrix>& values,
                std::vector<Matrix>& by_exchange) const {
    const auto add = [&](std::size_t a, bool by_image, const auto& block) {
      if (!by_image) {
        values[a] += block;
      } else if (by_exchange[a].size() == 0) {
        by_exchange[a] = block;
      } else {
        by_exchange[a] += block;
      }
    };
    std::vector<Packing> to(static_cast<std::size_t>(partition.ranks().size()));
    for_each_block(near, from, [&](std::size_t a, bool by_image, const auto& block) {
      if (!partition.is_local(a)) to[static_cast<std::size_t>(partition.owner(a))](a, by_image, Matrix(block));
    });
    std::vector<std::string> parcels;
    for (Packing& parcel : to) parcels.push_back(parcel.take());
    parcels = partition.ranks().exchange(parcels);
    for (int rank = 0; rank < partition.ranks().size(); ++rank) {
      if (rank == partition.ranks().rank()) {
        for_each_block(near, from, [&](std::size_t a, bool by_image, const auto& block) {
          if (partition.is_local(a)) add(a, by_image, block);
        });
      }
      Unpacking parcel(parcels[static_cast<std::size_t>(rank)]);
      while (!parcel.is_empty()) {
        std::size_t a = 0;
        bool by_image = false;
        Matrix block;
        parcel(a, by_image, block);
        add(a, by_image, block);
      }
    }
  }

  /// Calls body(target, false, values there) for all targets near to each source, in the order of the sources, and
  /// body(target, true, coefficients there) for the layers of its images.
  template <class Body>
  void for_each_block(const NearLayers& near, const std::vector<Matrix>& from, const Body& body) const {
    for (std::size_t b = 0; b < n(); ++b) {
      if (from[b].size() == 0) continue;
      Index first = 0;
      for (const NearNodes& nodes : near.near[b]) {
        const Index count = images[nodes.at].n_originals();
        const auto block = from[b].middleRows(first, count);
        for (const Use& use : nodes.uses) {
          if (use.source == b) {
            body(use.target, false, block);
            continue;
          }
          const ImageOfFields& image = exchange.image(use.source);
          const Matrix there = analyzed(nodes.at, block);
          body(use.target, true, there.cols() == 1 ? image.potential(there) : image.vector(there));
        }
        first += count;
      }
    }
  }

  /// For each membrane of this rank, the nodes (or mirrored nodes) at which its layers are needed.
  /// @param is_needed  (target, source): is this pair needed?
  template <class IsNeeded>
  [[nodiscard]] std::vector<std::vector<NearNodes>> find_near(const IsNeeded& is_needed) const {
    std::vector<std::vector<NearNodes>> near(n());
    for (std::size_t b = 0; b < n(); ++b) {
      if (!partition.is_local(b)) continue;
      std::map<std::size_t, std::vector<Use>> uses;
      for (std::size_t c = 0; c < n(); ++c) {
        if (exchange.original(c) != b) continue;
        for (std::size_t a = 0; a < n(); ++a) {
          if (!exchange.is_image(a) && is_needed(a, c)) uses[exchange.preimage(c, a)].push_back({a, c});
        }
      }
      for (auto& [at, all] : uses) near[b].push_back({at, std::move(all)});
    }
    return near;
  }

  [[nodiscard]] std::vector<Vector> fluxes(PairLayer layer, const std::vector<Vector>& densities) const {
    std::vector<Vector> result = sums(layer, densities);
    for (Vector& flux : result) {
      if (flux.size() > 0) flux[0] = 0.0;
    }
    return result;
  }
};

Interaction::Interaction(const std::vector<InteractingMembrane>& membranes, const PairSettings& settings,
                         Instruments& instruments, Partition partition, Exchange exchange, SharedTransforms transforms,
                         const std::optional<Wall>& wall) {
  auto parts = std::make_unique<Parts>();
  parts->partition = std::move(partition);
  parts->exchange = std::move(exchange);
  parts->wall = wall;
  PairSettings of_one = settings;
  of_one.row_bytes /= static_cast<double>(parts->exchange.n_originals(membranes.size()));
  std::vector<TargetNodes> nodes;
  for (const InteractingMembrane& membrane : membranes) {
    parts->targets.push_back(membrane.nodes);
    parts->images.emplace_back(membrane.nodes.grid(), membrane.symmetry);
    nodes.push_back(parts->images.back().originals(target_nodes(membrane)));
  }
  if (membranes.size() > most_summed_membranes) {
    const auto timer = instruments.time("pair layers");
    std::vector<ExpandedMembrane> expanded;
    for (std::size_t a = 0; a < membranes.size(); ++a) {
      expanded.push_back({membranes[a].position, nodes[a].points, nodes[a].area_vectors});
    }
    parts->expansions.emplace(expanded, settings.tolerance, transforms, parts->partition);
  }
  // Layers of one membrane at the nodes near to it.
  const auto add_layers = [&](NearLayers& near, std::size_t b, const std::vector<TargetNodes>& at,
                              const PairSelection& selection, const MirrorPlane& plane, const char* other) {
    std::optional<PairLayers>& layers = near.layers.emplace_back();
    Index n_near = 0;
    for (const NearNodes& one : near.near[b]) n_near += at[one.at].points.rows();
    if (n_near == 0) return;
    TargetNodes all{Matrix(n_near, 3), Matrix(n_near, 3)};
    Index first = 0;
    for (const NearNodes& one : near.near[b]) {
      const TargetNodes& there = at[one.at];
      all.points.middleRows(first, there.points.rows()) = there.points;
      all.area_vectors.middleRows(first, there.points.rows()) = there.area_vectors;
      first += there.points.rows();
    }
    try {
      layers.emplace(membranes[b].position, all.points, all.area_vectors, selection, of_one, transforms, instruments,
                     plane);
    } catch (const ConvergenceError& error) {
      throw ConvergenceError(fmt::format("membrane {} of {} and {}: {}", b + 1, membranes.size(), other, error.what()));
    }
  };
  parts->direct.near = parts->find_near(
      [&](std::size_t a, std::size_t b) { return a != b && !(parts->expansions && parts->expansions->is_far(a, b)); });
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    add_layers(parts->direct, b, nodes, membranes[b].selection, {}, "another one");
  }
  if (wall) {
    for (TargetNodes& there : nodes) there = mirrored(*wall, there);
    parts->of_images.near = parts->find_near([](std::size_t, std::size_t) { return true; });
    for (std::size_t b = 0; b < membranes.size(); ++b) {
      add_layers(parts->of_images, b, nodes, selection_of_image(*wall, membranes[b].selection),
                 {wall->point, wall->normal}, "the wall");
    }
  }
  parts_ = std::move(parts);
  const PairCounts all = counts();
  instruments.count_pair_targets("near", static_cast<std::uint64_t>(all.near));
  instruments.count_pair_targets("far", static_cast<std::uint64_t>(all.far));
  instruments.count_pair_targets("expanded", static_cast<std::uint64_t>(all.expanded));
}

Interaction::Interaction() : parts_(std::make_unique<const Parts>()) {}

Interaction::~Interaction() = default;
Interaction::Interaction(Interaction&&) noexcept = default;

bool Interaction::is_empty() const { return parts_->n() == 0; }

const Partition& Interaction::partition() const { return parts_->partition; }

const Exchange& Interaction::exchange() const { return parts_->exchange; }

std::vector<Vector> Interaction::weighted_single_flux(const std::vector<Vector>& weighted) const {
  return parts_->fluxes(PairLayer::laplace_single_normal, weighted);
}
std::vector<Vector> Interaction::weighted_double_flux(const std::vector<Vector>& densities) const {
  return parts_->fluxes(PairLayer::laplace_double_normal, densities);
}
std::vector<Vector> Interaction::single_potential(const std::vector<Vector>& weighted) const {
  return parts_->sums(PairLayer::laplace_single, weighted);
}
std::vector<Vector> Interaction::double_potential(const std::vector<Vector>& densities) const {
  return parts_->sums(PairLayer::laplace_double, densities);
}
std::vector<Matrix> Interaction::stokes_single(const std::vector<Matrix>& weighted) const {
  return parts_->sums(PairLayer::stokes_single, weighted);
}
std::vector<Matrix> Interaction::stokes_double(const std::vector<Matrix>& velocities) const {
  return parts_->sums(PairLayer::stokes_double, velocities);
}

PairCounts Interaction::counts() const {
  PairCounts all;
  for (const NearLayers* near : {&parts_->direct, &parts_->of_images}) {
    for (const std::optional<PairLayers>& layers : near->layers) {
      if (!layers) continue;
      all.far += layers->counts().far;
      all.near += layers->counts().near;
    }
  }
  if (parts_->expansions) all.expanded = parts_->expansions->n_targets();
  return all;
}

}  // namespace vehd

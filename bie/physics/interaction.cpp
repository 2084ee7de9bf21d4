#include "bie/physics/interaction.hpp"

#include <fmt/format.h>

#include "bie/support/errors.hpp"

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

/// Of rows for all pairs.
double bytes_of_rows(const std::vector<InteractingMembrane>& membranes, const std::vector<TargetNodes>& nodes,
                     Index n_all) {
  double bytes = 0.0;
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    bytes += 8.0 * static_cast<double>(n_all - nodes[b].points.rows()) *
             static_cast<double>(membranes[b].position.rows()) * PairColumns(membranes[b].selection).count;
  }
  return bytes;
}

}  // namespace

Interaction::Interaction(const std::vector<InteractingMembrane>& membranes, const PairSettings& settings,
                         Instruments& instruments) {
  PairSettings of_one = settings;
  of_one.row_bytes /= static_cast<double>(membranes.size());
  std::vector<TargetNodes> nodes;
  Index n_all = 0;
  for (const InteractingMembrane& membrane : membranes) {
    targets_.push_back(membrane.nodes);
    nodes.push_back(target_nodes(membrane));
    n_all += nodes.back().points.rows();
  }
  if (bytes_of_rows(membranes, nodes, n_all) > settings.row_bytes) {
    const auto timer = instruments.time("pair layers");
    std::vector<ExpandedMembrane> expanded;
    for (std::size_t a = 0; a < membranes.size(); ++a) {
      expanded.push_back({membranes[a].position, nodes[a].points, nodes[a].area_vectors});
    }
    expansions_.emplace(expanded, settings.tolerance);
  }
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    std::vector<std::size_t>& near = near_.emplace_back();
    Index n_near = 0;
    for (std::size_t a = 0; a < membranes.size(); ++a) {
      if (a == b || (expansions_ && expansions_->is_far(a, b))) continue;
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
      layers_.emplace_back(membranes[b].position, others.points, others.area_vectors, membranes[b].selection, of_one,
                           instruments);
    } catch (const ConvergenceError& error) {
      throw ConvergenceError(
          fmt::format("membrane {} of {} and another one: {}", b + 1, membranes.size(), error.what()));
    }
  }
}

template <class Field, class Layer, class Expanded>
std::vector<Field> Interaction::sums(const std::vector<Field>& densities, Index components, const Layer& layer,
                                     const Expanded& expanded) const {
  require_size("densities of membranes", static_cast<long>(densities.size()), static_cast<long>(n_membranes()));
  std::vector<Matrix> values;
  if (expansions_) {
    values = expanded(*expansions_, densities);
  } else {
    for (const SphereTransform& nodes : targets_) {
      values.emplace_back(Matrix::Zero(nodes.grid().n_points(), components));
    }
  }
  for (std::size_t b = 0; b < n_membranes(); ++b) {
    if (densities[b].size() == 0) continue;
    const Matrix from_b = layer(layers_[b], densities[b]);
    Index first = 0;
    for (const std::size_t a : near_[b]) {
      values[a] += from_b.middleRows(first, values[a].rows());
      first += values[a].rows();
    }
  }
  std::vector<Field> result;
  for (std::size_t a = 0; a < n_membranes(); ++a) result.emplace_back(targets_[a].analyze(values[a]));
  return result;
}

template <class Layer, class Expanded>
std::vector<Vector> Interaction::fluxes(const std::vector<Vector>& densities, const Layer& layer,
                                        const Expanded& expanded) const {
  std::vector<Vector> result = sums(densities, 1, layer, expanded);
  for (Vector& flux : result) flux[0] = 0.0;
  return result;
}

std::vector<Vector> Interaction::weighted_single_flux(const std::vector<Vector>& weighted) const {
  return fluxes(
      weighted, [](const PairLayers& layers, const Vector& f) { return layers.laplace_single_normal(f); },
      [](const FarExpansions& far, const std::vector<Vector>& f) { return far.laplace_single_normal(f); });
}

std::vector<Vector> Interaction::weighted_double_flux(const std::vector<Vector>& densities) const {
  return fluxes(
      densities, [](const PairLayers& layers, const Vector& f) { return layers.laplace_double_normal(f); },
      [](const FarExpansions& far, const std::vector<Vector>& f) { return far.laplace_double_normal(f); });
}

std::vector<Vector> Interaction::single_potential(const std::vector<Vector>& weighted) const {
  return sums(
      weighted, 1, [](const PairLayers& layers, const Vector& f) { return layers.laplace_single(f); },
      [](const FarExpansions& far, const std::vector<Vector>& f) { return far.laplace_single(f); });
}

std::vector<Vector> Interaction::double_potential(const std::vector<Vector>& densities) const {
  return sums(
      densities, 1, [](const PairLayers& layers, const Vector& f) { return layers.laplace_double(f); },
      [](const FarExpansions& far, const std::vector<Vector>& f) { return far.laplace_double(f); });
}

std::vector<Matrix> Interaction::stokes_single(const std::vector<Matrix>& weighted) const {
  return sums(
      weighted, 3, [](const PairLayers& layers, const Matrix& f) { return layers.stokes_single(f); },
      [](const FarExpansions& far, const std::vector<Matrix>& f) { return far.stokes_single(f); });
}

std::vector<Matrix> Interaction::stokes_double(const std::vector<Matrix>& velocities) const {
  return sums(
      velocities, 3, [](const PairLayers& layers, const Matrix& f) { return layers.stokes_double(f); },
      [](const FarExpansions& far, const std::vector<Matrix>& f) { return far.stokes_double(f); });
}

PairCounts Interaction::counts() const {
  PairCounts all;
  for (const PairLayers& layers : layers_) {
    all.far += layers.counts().far;
    all.near += layers.counts().near;
    all.far_nodes += layers.counts().far_nodes;
  }
  return all;
}

}  // namespace vehd

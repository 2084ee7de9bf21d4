#include "bie/potentials/off_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/potentials/foot_point.hpp"
#include "bie/potentials/smooth_grid.hpp"
#include "bie/potentials/target_frame.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/point_derivatives.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Least distance over spacing of the coarser smooth grid at which the smooth rule is tried: exp(−2π 3.5) = 3e-10.
constexpr double kFarSpacings = 3.5;

/// Sums times 1/(4π), 1/(8π) for the Stokes single layer at μ = 1 and 3/(4π) for the Stokes double layer, Eqs. (6),
/// (9).
LayersAt with_prefactors(LayersAt sums) {
  for (std::size_t layer = 0; layer < LayersAt::count; ++layer) {
    sums.of[layer] *= layer == LayersAt::stokes          ? stokes_single_layer_prefactor(1.0)
                      : layer == LayersAt::stokes_double ? kStokesDoubleLayerPrefactor
                                                         : kLaplacePrefactor;
  }
  sums.enclosure *= kLaplacePrefactor;
  return sums;
}

/// D[1]: −1 inside, 0 outside, −½ on the membrane.
double enclosure_of(Side side) {
  switch (side) {
    case Side::interior:
      return -1.0;
    case Side::exterior:
      return 0.0;
    case Side::principal_value:
      break;
  }
  return -0.5;
}

/// One size per layer: of a change, or the scale of changes.
using LayerSizes = std::array<double, LayersAt::count>;

/// Absolute change of every layer from one evaluation to another.
LayerSizes change(const LayersAt& a, const LayersAt& b) {
  LayerSizes sizes{};
  for (std::size_t layer = 0; layer < sizes.size(); ++layer) sizes[layer] = (a.of[layer] - b.of[layer]).norm();
  return sizes;
}

/// Scales of changes of the layers: the largest densities on the membrane, times √(area/4π) for the single layers; the
/// largest ∇_γ f for ∇D.
LayerSizes density_sizes(const SmoothGrid& grid, const NodeColumns& columns) {
  const double radius = mean_radius(grid);
  const Vector area = grid.area_vectors.rowwise().norm();
  LayerSizes sizes{};
  if (columns.single >= 0) {
    sizes[LayersAt::single_gradient] = grid.nodes.col(columns.single).cwiseQuotient(area).cwiseAbs().maxCoeff();
    sizes[LayersAt::single] = radius * sizes[LayersAt::single_gradient];
  }
  if (columns.double_layer >= 0)
    sizes[LayersAt::double_layer] = grid.nodes.col(columns.double_layer).cwiseAbs().maxCoeff();
  if (columns.double_1 >= 0) {
    for (Index i = 0; i < area.size(); ++i) {
      const auto node = grid.nodes.row(i);
      const Vector3 rotated_gradient = (node[columns.double_1] * node.segment<3>(columns.tangent_2) -
                                        node[columns.double_2] * node.segment<3>(columns.tangent_1))
                                           .transpose();
      sizes[LayersAt::double_gradient] = std::max(sizes[LayersAt::double_gradient], rotated_gradient.norm() / area[i]);
    }
  }
  if (columns.stokes >= 0) {
    const Vector weighted = grid.nodes.middleCols(columns.stokes, 3).rowwise().norm();
    sizes[LayersAt::stokes] = radius * weighted.cwiseQuotient(area).maxCoeff();
  }
  if (columns.stokes_double >= 0) {
    sizes[LayersAt::stokes_double] = grid.nodes.middleCols(columns.stokes_double, 3).rowwise().norm().maxCoeff();
  }
  return sizes;
}

bool is_small(const LayerSizes& change, const LayerSizes& sizes, double tolerance) {
  return std::ranges::equal(change, sizes, [=](double moved, double size) { return moved <= tolerance * size; });
}

/// Densities at the foot point that enter the one-sided limits of the gradients.
struct FootDensities {
  double single = 0.0;                         ///< f, not J f
  Vector3 surface_gradient = Vector3::Zero();  ///< ∇_γ f of the double layer
};

/// A target, its position relative to the membrane, and its results.
struct FreeTarget {
  Vector3 point;
  NearestNodes nearest;
  FootPoint foot;
  bool near = false;
  bool on_membrane = false;
  NearRule rule;
  Side side = Side::exterior;
  double distance = 0.0;
  LayersAt values;
  LayerSizes last_change{};
  bool resolved = false;
};

}  // namespace

struct OffSurfaceLayers::Data {
  OffSurfaceSettings settings;
  int order;
  Matrix position;
  LayerDensities densities;
  LayerFields fields;
  SmoothGrid coarse, fine;
  double radius;
  LayerSizes sizes;

  Data(const Matrix& x, LayerDensities given, const OffSurfaceSettings& options)
      : settings(options),
        order(order_of(x.rows())),
        position(x),
        densities(std::move(given)),
        fields(make_layer_fields(position, densities)),
        coarse(make_smooth_grid(fields, 2 * order + 8)),
        fine(make_smooth_grid(fields, 3 * order + 12)),
        radius(mean_radius(coarse)),
        sizes(density_sizes(coarse, fields.columns)) {}

  /// Applies the smooth rule if it suffices. @return nodes visited
  Index try_far(FreeTarget& target) const {
    target.nearest = nearest_nodes(coarse, target.point);
    target.distance = target.nearest.distance;
    target.near = target.distance < kFarSpacings * coarse.spacing[target.nearest.first];
    if (target.near) return 0;
    target.values = with_prefactors(smooth_sums(fine, fields.columns, target.point));
    target.last_change = change(target.values, with_prefactors(smooth_sums(coarse, fields.columns, target.point)));
    target.side = target.values.enclosure < -0.5 ? Side::interior : Side::exterior;
    const double defect = std::abs(target.values.enclosure - enclosure_of(target.side));
    target.resolved = is_small(target.last_change, sizes, settings.tolerance) && defect < settings.tolerance;
    target.near = !target.resolved;
    return coarse.n_nodes() + fine.n_nodes();
  }

  void locate(FreeTarget& target, Side membrane_side) const {
    target.foot = nearest_feet(position, coarse, {target.nearest}, target.point.transpose()).front();
    target.distance = std::abs(target.foot.height);
    target.on_membrane = target.distance < settings.membrane_distance * radius;
    target.side = target.on_membrane ? membrane_side : target.foot.height < 0.0 ? Side::interior : Side::exterior;
    target.rule = near_rule(target.foot, order, settings.tolerance, target.on_membrane);
  }

  [[nodiscard]] FootDensities foot_densities(const FootPoint& foot) const {
    FootDensities result;
    if (fields.single >= 0) {
      result.single = point_derivatives(densities.laplace_single, {foot.theta, foot.phi}).value[0];
      if (!densities.plain) result.single /= foot.area_element;
    }
    if (fields.columns.double_1 >= 0) {
      const PointDerivatives f = point_derivatives(densities.laplace_double, {foot.theta, foot.phi});
      const PointDerivatives x = point_derivatives(position, {foot.theta, foot.phi});
      const Vector3 u = x.d1.transpose();
      const Vector3 v = x.d2.transpose();
      // J n×∇_γ f = f_1 x_2 − f_2 x_1, and ∇_γ f = −n×(n×∇_γ f).
      result.surface_gradient = (f.d1[0] * v - f.d2[0] * u).cross(foot.normal) / foot.area_element;
    }
    return result;
  }

  /// Values from the sums about the foot point.
  [[nodiscard]] LayersAt near_values(const FreeTarget& target, const TargetFrame& frame, const FootDensities& at_foot,
                                     const LayersAt& sums) const {
    LayersAt v = with_prefactors(sums);
    if (fields.double_layer >= 0)
      v.of[LayersAt::double_layer][0] += frame.pole()[fields.double_layer] * enclosure_of(target.side);
    if (fields.stokes_double >= 0) {
      v.of[LayersAt::stokes_double] +=
          frame.pole().segment<3>(fields.stokes_double).transpose() * enclosure_of(target.side);
    }
    if (target.on_membrane) {
      // The sums are principal values there; the interior limits add ½ f n to ∇S and −½ ∇_γ f to ∇D.
      const double jump = enclosure_of(Side::principal_value) - enclosure_of(target.side);
      v.of[LayersAt::single_gradient] += jump * at_foot.single * target.foot.normal;
      v.of[LayersAt::double_gradient] -= jump * at_foot.surface_gradient;
    }
    return v;
  }

  /// Applies the rules in turn, each compared with the one before. @return nodes visited
  Index run_rules(FreeTarget& target, const std::vector<GradedRule>& rules, bool first) const {
    const TargetFrame frame(fields, target.foot.theta, target.foot.phi);
    const FootDensities at_foot = target.on_membrane ? foot_densities(target.foot) : FootDensities{};
    const Vector3 offset = target.on_membrane ? Vector3::Zero() : Vector3(target.point - target.foot.position);
    Index nodes = 0;
    for (const GradedRule& r : rules) {
      const LayersAt next = near_values(target, frame, at_foot, frame.integrate(r, offset));
      nodes += r.n_nodes();
      if (!first) {
        target.last_change = change(next, target.values);
        const double expected = target.on_membrane ? -0.5 : enclosure_of(target.side);
        // A wrong solid angle indicates another part of the membrane that the nodes do not resolve.
        constexpr double kEnclosureDefect = 1e-2;
        target.resolved = is_small(target.last_change, sizes, settings.tolerance) &&
                          std::abs(next.enclosure - expected) < kEnclosureDefect;
      }
      target.values = next;
      first = false;
    }
    return nodes;
  }
};

OffSurfaceLayers::OffSurfaceLayers(const Matrix& position, LayerDensities densities, const OffSurfaceSettings& settings)
    : data_(std::make_unique<const Data>(position, std::move(densities), settings)) {}

OffSurfaceLayers::~OffSurfaceLayers() = default;
OffSurfaceLayers::OffSurfaceLayers(OffSurfaceLayers&&) noexcept = default;
OffSurfaceLayers& OffSurfaceLayers::operator=(OffSurfaceLayers&&) noexcept = default;

namespace {

/// A layer: whether it was requested, and where its values go.
struct RequestedLayer {
  bool requested;
  LayerField OffSurfaceValues::*field;
  Index components;
  const char* kernel;  ///< its name in the instruments
};

/// In the order of LayersAt.
std::array<RequestedLayer, LayersAt::count> layers_of(const NodeColumns& columns) {
  using Values = OffSurfaceValues;
  return {{{columns.single >= 0, &Values::laplace_single, 1, "laplace_single"},
           {columns.single_gradient, &Values::laplace_single_gradient, 3, "laplace_single_gradient"},
           {columns.double_layer >= 0, &Values::laplace_double, 1, "laplace_double"},
           {columns.double_1 >= 0, &Values::laplace_double_gradient, 3, "laplace_double_gradient"},
           {columns.stokes >= 0, &Values::stokes_single, 3, "stokes_single"},
           {columns.stokes_double >= 0, &Values::stokes_double, 3, "stokes_double"}}};
}

OffSurfaceValues collect(const std::vector<FreeTarget>& targets, const NodeColumns& columns) {
  const Index n = std::ssize(targets);
  OffSurfaceValues out;
  const auto layers = layers_of(columns);
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    if (!layers[layer].requested) continue;
    LayerField& field = out.*layers[layer].field;
    field.values.resize(n, layers[layer].components);
    field.error.resize(n);
    for (Index i = 0; i < n; ++i) {
      field.values.row(i) = targets[i].values.of[layer].head(field.values.cols()).transpose();
      field.error[i] = targets[i].last_change[layer];
    }
  }
  out.side.resize(targets.size());
  out.distance.resize(n);
  out.resolved.resize(n);
  for (Index i = 0; i < n; ++i) {
    out.side[i] = targets[i].side;
    out.distance[i] = targets[i].distance;
    out.resolved[i] = targets[i].resolved;
  }
  return out;
}

}  // namespace

OffSurfaceValues OffSurfaceLayers::evaluate(const Matrix& points, Side side, Instruments& instruments) const {
  require_size("points (Cartesian components)", points.cols(), 3);
  const auto timer = instruments.time("off-surface evaluation");
  const Data& data = *data_;
  const Index n = points.rows();
  std::vector<FreeTarget> targets(n);
  Exceptions exceptions(n);
  std::uint64_t evaluations = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(+ : evaluations)
  for (Index i = 0; i < n; ++i) {
    exceptions.keep(i, [&] {
      FreeTarget& target = targets[i];
      target.point = points.row(i).transpose();
      evaluations += data.try_far(target);
      if (target.near) data.locate(target, side);
    });
  }
  exceptions.rethrow_first();

  // Targets with equal rules share the tables.
  for (int stage = 1; stage < data.settings.max_rules; ++stage) {
    std::map<NearRule, std::vector<Index>> groups;
    for (Index i = 0; i < n; ++i) {
      if (!targets[i].resolved) groups[targets[i].rule].push_back(i);
    }
    for (const auto& [choice, group] : groups) {
      const std::vector<Index>& members = group;  // OpenMP takes no structured binding
      std::vector<GradedRule> rules;
      if (stage == 1) rules.push_back(make_near_rule(data.order, choice, 0));
      rules.push_back(make_near_rule(data.order, choice, stage));
      const Index n_members = static_cast<Index>(members.size());
#pragma omp parallel for schedule(dynamic, 1) reduction(+ : evaluations)
      for (Index i = 0; i < n_members; ++i) evaluations += data.run_rules(targets[members[i]], rules, stage == 1);
    }
    if (groups.empty()) break;
  }
  for (const RequestedLayer& layer : layers_of(data.fields.columns)) {
    if (layer.requested) instruments.count_kernel(layer.kernel, evaluations);
  }
  return collect(targets, data.fields.columns);
}

void require_resolved(const OffSurfaceValues& values, const Matrix& points) {
  for (Index i = 0; i < values.resolved.size(); ++i) {
    if (values.resolved[i]) continue;
    throw ConvergenceError(
        fmt::format("layer potentials at ({:.6g}, {:.6g}, {:.6g}), {:.3g} from the membrane: the finest rules still "
                    "disagree; another part of the membrane may be as near, or its degree too low for its shape",
                    points(i, 0), points(i, 1), points(i, 2), values.distance[i]));
  }
}

}  // namespace vehd

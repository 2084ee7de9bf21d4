#include "bie/potentials/pair_layers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "bie/kernels/stokes.hpp"
#include "bie/potentials/far_rule.hpp"
#include "bie/potentials/near_rows.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Far grids have orders that are multiples of this, so that targets share them.
constexpr int kOrderStep = 4;

/// Targets that share a grid.
struct FarGroup {
  std::shared_ptr<const FarRule> rule;
  std::vector<Index> targets;
};

/// Targets evaluated by rows over the coefficients.
struct RowTargets {
  PairColumns columns;
  std::vector<Index> targets;
  Matrix rows;  ///< [n_coefficients x PairColumns::count], one target after another

  [[nodiscard]] auto row(Index k, int column) const { return rows.col(k * columns.count + column); }
};

/// Calls body(index of the first, targets) for every batch of targets.
template <class Body>
void for_each_batch(const std::vector<Index>& targets, const Body& body) {
  constexpr Index kBatch = 16;
  const Index n = static_cast<Index>(targets.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (Index first = 0; first < n; first += kBatch) {
    body(first, std::vector<Index>(targets.begin() + first, targets.begin() + std::min(n, first + kBatch)));
  }
}

/// A layer at far targets: some by rows, the others summed at every application.
struct FarLayers {
  bool selected;
  RowTargets by_rows;
  std::vector<FarGroup> groups;
};

/// @param rows  selects the layer if it is evaluated by rows as far as memory allows
FarLayers far_layers(bool selected, const PairSelection& rows = {}) {
  return {selected, {PairColumns(rows), {}, {}}, {}};
}

int next_multiple(double order) { return kOrderStep * static_cast<int>(std::ceil(order / kOrderStep)); }

/// Highest order of far grids; beyond it rows of near targets take less time over about ten applications.
int highest_grid_order(int order) { return next_multiple(2 * order + 8); }

double nodes_of_grid(int order) { return 2.0 * (order + 1.0) * (order + 1.0); }

/// Moves the targets of a grid to the next finer one if they are too few for synthesis on a grid of their own to pay:
/// it takes as long as the sums over its nodes for about ten targets.
std::map<int, std::vector<Index>> merged(const std::map<int, std::vector<Index>>& targets_of_order) {
  constexpr double kTargetsOfSynthesis = 10.0;
  std::map<int, std::vector<Index>> result;
  std::vector<Index> waiting;
  for (auto it = targets_of_order.begin(); it != targets_of_order.end(); ++it) {
    waiting.insert(waiting.end(), it->second.begin(), it->second.end());
    const auto next = std::next(it);
    if (next != targets_of_order.end()) {
      const double more = nodes_of_grid(next->first) / nodes_of_grid(it->first) - 1.0;
      if (static_cast<double>(waiting.size()) * more < kTargetsOfSynthesis) continue;
    }
    result[it->first] = std::exchange(waiting, {});
  }
  return result;
}

/// Rules of one membrane, each made once.
class FarRules {
 public:
  FarRules(const Matrix& position, SharedTransforms& transforms)
      : position_(position), order_(order_of(position.rows())), transforms_(transforms) {}
  std::shared_ptr<const FarRule> of_order(int grid_order) {
    std::shared_ptr<const FarRule>& rule = rules_[grid_order];
    if (!rule) rule = std::make_shared<const FarRule>(position_, transforms_.of(order_, grid_order));
    return rule;
  }

 private:
  const Matrix& position_;
  int order_;
  SharedTransforms& transforms_;
  std::map<int, std::shared_ptr<const FarRule>> rules_;
};

}  // namespace

void prepare_pair_transforms(int order, SharedTransforms& transforms) {
  const int highest = highest_grid_order(order);
  for (int q = next_multiple(order); q <= highest; q += kOrderStep) transforms.of(order, q);
  transforms.of(2 * order, highest);
}

struct PairLayers::Data {
  PairSettings settings;
  int order;
  PairGeometry at;
  Vector inverse_reach2;  ///< 1/c² at the nodes of the grid, c the length of a unit angle there
  int area_degree;        ///< beyond which J n, the factor of densities of double layers, is negligible
  RowTargets near;
  FarLayers single, double_layer;
  /// Layers that are applied often enough for rows to pay.
  FarLayers single_normal, double_normal, stokes_double_layer;
  FarLayers no_slip_double;
  PairCounts counts;

  Data(const Matrix& x, const Matrix& targets, const Matrix& normals, const PairSelection& selection,
       const PairSettings& options, SharedTransforms& transforms, const MirrorPlane& plane)
      : settings(options),
        order(order_of(x.rows())),
        at{x, targets, normals, make_layer_fields(x, {}), {}, plane},
        near{PairColumns(selection), {}, {}},
        single(far_layers(selection.laplace_single || selection.stokes_single || selection.no_slip_single)),
        double_layer(far_layers(selection.laplace_double)),
        single_normal(far_layers(selection.laplace_single_normal, {.laplace_single_normal = true})),
        double_normal(far_layers(selection.laplace_double_normal, {.laplace_double_normal = true})),
        stokes_double_layer(far_layers(selection.stokes_double, {.stokes_double = true})),
        no_slip_double(far_layers(selection.no_slip_double)) {
    const int highest = highest_grid_order(order);
    at.grid = make_smooth_grid(at.fields, transforms.of(order, highest));
    inverse_reach2 = (at.grid.spacing * (highest / std::numbers::pi)).cwiseAbs2().cwiseInverse();
    const Vector sizes = transforms.of(2 * order, highest).analyze(at.grid.area_vectors).rowwise().norm();
    area_degree = 2 * order;
    const auto left = [&sizes](int n) { return sizes.tail(sizes.size() - Index{n} * n).norm(); };
    while (area_degree > 0 && left(area_degree) <= settings.tolerance * sizes.norm()) --area_degree;
  }

  /// Order of the grid that resolves the product of kernel, J n and a density of degree p: the kernel's coefficients
  /// fall like (1 + distance/reach)^−n as on a sphere, and the rule is exact up to the degree 2q + 1 of their product.
  [[nodiscard]] int grid_order(double least_ratio2) const {
    const double degree_of_kernel = std::log(1.0 / settings.tolerance) / std::log1p(std::sqrt(least_ratio2));
    return next_multiple(std::clamp(0.5 * (order + area_degree + degree_of_kernel), static_cast<double>(order), 1e6));
  }

  /// The order without J n, which the densities of single layers already contain.
  [[nodiscard]] int single_grid_order(int grid_order) const {
    return std::max(next_multiple(order), grid_order - kOrderStep * (area_degree / (2 * kOrderStep)));
  }

  /// @return far targets by order of the grid
  std::map<int, std::vector<Index>> sort_targets(FarRules& rules) {
    const int highest = highest_grid_order(order);
    std::map<int, std::vector<Index>> by_order, sorted;
    std::vector<Index> all(static_cast<std::size_t>(at.points.rows()));
    std::iota(all.begin(), all.end(), Index{0});
    std::vector<int> wanted(all.size());
    for_each_batch(all, [&](Index first, const std::vector<Index>& batch) {
      const Vector ratios2 = least_weighted_squares(at.grid, inverse_reach2, points(batch));
      for (Index k = 0; k < ratios2.size(); ++k) wanted[static_cast<std::size_t>(first + k)] = grid_order(ratios2[k]);
    });
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      (wanted[i] > highest ? near.targets : by_order[wanted[i]]).push_back(static_cast<Index>(i));
    }
    // A rule whose D[1] differs from its value outside is too coarse for the target.
    for (int q = order; q <= highest; ++q) {
      const auto found = by_order.find(q);
      if (found == by_order.end()) continue;
      const std::vector<Index>& targets = found->second;
      const FarRule& rule = *rules.of_order(q);
      std::vector<double> enclosures(targets.size());
      for_each_batch(targets, [&](Index first, const std::vector<Index>& batch) {
        Vector::Map(enclosures.data() + first, static_cast<Index>(batch.size())) = rule.enclosures(points(batch));
      });
      for (std::size_t k = 0; k < targets.size(); ++k) {
        if (std::abs(enclosures[k]) <= settings.tolerance) {
          sorted[q].push_back(targets[k]);
        } else if (q + kOrderStep <= highest) {
          by_order[q + kOrderStep].push_back(targets[k]);
        } else {
          near.targets.push_back(targets[k]);
        }
      }
    }
    std::sort(near.targets.begin(), near.targets.end());
    return sorted;
  }

  void make(SharedTransforms& transforms) {
    FarRules rules(at.source, transforms);
    const std::map<int, std::vector<Index>> far = sort_targets(rules);
    counts.near = static_cast<Index>(near.targets.size());
    if (near.columns.count > 0) {
      near.rows = rows_of_near_targets(at, near.targets, near.columns, {settings.tolerance, settings.max_rules});
    }
    double room = settings.row_bytes;
    std::map<int, std::vector<Index>> of_single;
    for (const auto& [q, targets] : far) {
      counts.far += static_cast<Index>(targets.size());
      std::vector<Index>& all = of_single[single_grid_order(q)];
      all.insert(all.end(), targets.begin(), targets.end());
    }
    make_far(merged(of_single), rules, single, room);
    make_far(merged(far), rules, double_layer, room);
    make_far(of_single, rules, single_normal, room);
    make_far(far, rules, double_normal, room);
    make_far(far, rules, stokes_double_layer, room);
    make_far(far, rules, no_slip_double, room);
  }

  /// Makes rows of far targets as long as memory allows, the finest grids first because they gain most.
  void make_far(const std::map<int, std::vector<Index>>& targets_of_order, FarRules& rules, FarLayers& layers,
                double& room) {
    if (!layers.selected) return;
    for (const auto& [q, targets] : targets_of_order) {
      layers.groups.push_back({rules.of_order(q), targets});
    }
    const Index n_columns = layers.by_rows.columns.count;
    if (n_columns == 0) return;
    const double bytes_of_one = 8.0 * static_cast<double>(n_columns) * static_cast<double>(at.source.rows());
    std::vector<FarGroup> chosen;
    std::vector<Index>& by_rows = layers.by_rows.targets;
    while (!layers.groups.empty()) {
      FarGroup& finest = layers.groups.back();
      const double bytes = static_cast<double>(finest.targets.size()) * bytes_of_one;
      if (bytes > room) break;
      room -= bytes;
      by_rows.insert(by_rows.end(), finest.targets.begin(), finest.targets.end());
      chosen.push_back(std::move(finest));
      layers.groups.pop_back();
    }
    layers.by_rows.rows.resize(at.source.rows(), static_cast<Index>(by_rows.size()) * n_columns);
    Index first = 0;
    for (const FarGroup& group : chosen) {
      fill_rows(group, first, layers.by_rows);
      first += static_cast<Index>(group.targets.size());
    }
  }

  void fill_rows(const FarGroup& group, Index first, RowTargets& all) const {
    const Index n_columns = all.columns.count;
    const auto layer = static_cast<PairLayer>(std::ranges::find(all.columns.first, 0) - all.columns.first.begin());
    for_each_batch(group.targets, [&](Index start, const std::vector<Index>& batch) {
      all.rows.middleCols((first + start) * n_columns, static_cast<Index>(batch.size()) * n_columns) =
          group.rule->rows(layer, points(batch), normals(batch));
    });
  }

  [[nodiscard]] Matrix points(const std::vector<Index>& targets) const { return at.points(targets, Eigen::all); }
  [[nodiscard]] Matrix normals(const std::vector<Index>& targets) const { return at.normals(targets, Eigen::all); }

  [[nodiscard]] const FarLayers& far(PairLayer layer) const {
    switch (layer) {
      case PairLayer::laplace_single:
      case PairLayer::stokes_single:
      case PairLayer::no_slip_single:
        return single;
      case PairLayer::laplace_single_normal:
        return single_normal;
      case PairLayer::laplace_double:
        return double_layer;
      case PairLayer::laplace_double_normal:
        return double_normal;
      case PairLayer::stokes_double:
        return stokes_double_layer;
      case PairLayer::no_slip_double:
        break;
    }
    return no_slip_double;
  }

  /// Evaluates the targets that have rows.
  static void put_rows(const RowTargets& all, PairLayer layer, const Matrix& density, Matrix& values) {
    const Index n = std::ssize(all.targets);
    const int first = all.columns[layer];
#pragma omp parallel for schedule(static)
    for (Index k = 0; k < n; ++k) {
      auto value = values.row(all.targets[k]);
      if (!is_stokes(layer)) {
        value[0] = all.row(k, first).dot(density.col(0));
        continue;
      }
      value.setZero();
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) value[i] += all.row(k, first + row_of_block(layer, i, j)).dot(density.col(j));
      }
    }
  }
};

PairLayers::PairLayers(const Matrix& source, const Matrix& points, const Matrix& normals,
                       const PairSelection& selection, const PairSettings& settings, SharedTransforms& transforms,
                       Instruments& instruments, const MirrorPlane& plane) {
  require_size("points (Cartesian components)", points.cols(), 3);
  require_size("normals", normals.rows(), points.rows());
  const auto timer = instruments.time("pair layers");
  auto data = std::make_unique<Data>(source, points, normals, selection, settings, transforms, plane);
  data->make(transforms);
  data_ = std::move(data);
}

PairLayers::~PairLayers() = default;
PairLayers::PairLayers(PairLayers&&) noexcept = default;
PairLayers& PairLayers::operator=(PairLayers&&) noexcept = default;

const PairCounts& PairLayers::counts() const { return data_->counts; }

Matrix PairLayers::apply(PairLayer layer, const Matrix& density) const {
  if (!data_->near.columns.has(layer)) throw std::logic_error("a layer between two membranes was not selected");
  require_size("density", density.rows(), data_->at.source.rows());
  Matrix values(data_->at.points.rows(), is_stokes(layer) ? 3 : 1);
  const FarLayers& far = data_->far(layer);
  for (const FarGroup& group : far.groups) {
    const Matrix charges = group.rule->charges(density);
    for_each_batch(group.targets, [&](Index, const std::vector<Index>& batch) {
      values(batch, Eigen::all) =
          group.rule->sums(layer, data_->points(batch), data_->normals(batch), charges, data_->at.plane);
    });
  }
  Data::put_rows(data_->near, layer, density, values);
  if (!far.by_rows.targets.empty()) Data::put_rows(far.by_rows, layer, density, values);
  return values;
}

}  // namespace vehd

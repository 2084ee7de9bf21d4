#include "bie/potentials/pair_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <numbers>
#include <stdexcept>

#include "bie/potentials/far_rule.hpp"
#include "bie/potentials/near_rule.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Far grids have orders that are multiples of this, so that targets share them.
constexpr int kOrderStep = 2;

/// Targets that share a grid.
struct FarGroup {
  FarRule rule;
  std::vector<Index> targets;
};

bool has_double_layers(const PairSelection& selection) {
  return selection.laplace_double || selection.laplace_double_normal || selection.stokes_double;
}

/// A target whose row is made of coefficients.
struct NearTarget {
  Index index = 0;
  FootPoint foot;
  NearRule rule;
};

}  // namespace

struct PairLayers::Data {
  PairSettings settings;
  int order;
  Matrix source, points, normals;
  PairColumns columns;
  LayerFields fields;
  SmoothGrid grid;
  Vector inverse_reach2;  ///< 1/c² at the nodes of the grid, c what a unit angle spans there
  int degree;             ///< of what the kernels multiply
  std::vector<FarGroup> far;
  std::vector<Index> near;
  std::vector<Index> by_rows;  ///< the near targets, behind them far ones
  Matrix rows;                 ///< [n_coefficients x columns], of one target behind the other
  PairCounts counts;

  Data(const Matrix& x, const Matrix& targets, const Matrix& n, const PairSelection& selection,
       const PairSettings& options)
      : settings(options),
        order(order_of(x.rows())),
        source(x),
        points(targets),
        normals(n),
        columns(selection),
        fields(make_layer_fields(source, {})),
        grid(make_smooth_grid(fields, highest_order())),
        inverse_reach2((grid.spacing * (highest_order() / std::numbers::pi)).cwiseAbs2().cwiseInverse()),
        degree(order + (has_double_layers(selection) ? area_degree() : 0)) {}

  /// Of far grids; beyond it rows of coefficients take less time over some ten applications.
  [[nodiscard]] int highest_order() const { return kOrderStep * ((2 * order + 8 + kOrderStep - 1) / kOrderStep); }

  [[nodiscard]] Vector3 point(Index i) const { return points.row(i).transpose(); }
  [[nodiscard]] Vector3 normal(Index i) const { return normals.row(i).transpose(); }

  /// Degree beyond which nothing is left of J n, which double layers multiply their densities by.
  [[nodiscard]] int area_degree() const {
    const SphereTransform transform(2 * order, make_grid(highest_order()));
    const Vector sizes = transform.analyze(grid.area_vectors).rowwise().norm();
    int n = 2 * order;
    while (n > 0 && sizes.tail(sizes.size() - n * n).norm() <= settings.tolerance * sizes.norm()) --n;
    return n;
  }

  /// Order of the grid that resolves the kernel of a target and what it multiplies: the kernel's coefficients fall like
  /// (1 + distance/reach)^−n as on a sphere, and the rule is exact up to the degree 2q + 1 of their product.
  [[nodiscard]] int grid_order(const Vector3& x) const {
    const auto component2 = [&](int i) { return (grid.nodes.col(i).array() - x[i]).square(); };
    const double ratio =
        std::sqrt(((component2(0) + component2(1) + component2(2)) * inverse_reach2.array()).minCoeff());
    const double degree_of_kernel = std::log(1.0 / settings.tolerance) / std::log1p(ratio);
    const double wanted = std::clamp(0.5 * (degree + degree_of_kernel), static_cast<double>(order), 1e6);
    return kOrderStep * static_cast<int>(std::ceil(wanted / kOrderStep));
  }

  void sort_targets() {
    std::map<int, std::vector<Index>> by_order;
    for (Index i = 0; i < points.rows(); ++i) {
      const int wanted = grid_order(point(i));
      if (wanted > highest_order()) {
        near.push_back(i);
      } else {
        by_order[wanted].push_back(i);
      }
    }
    // A rule whose D[1] is not that of the outside is too coarse for its target.
    for (int q = order; q <= highest_order(); ++q) {
      const auto found = by_order.find(q);
      if (found == by_order.end()) continue;
      FarGroup group{FarRule(source, q), {}};
      for (const Index i : found->second) {
        if (std::abs(group.rule.enclosure(point(i))) <= settings.tolerance) {
          group.targets.push_back(i);
        } else if (q + kOrderStep <= highest_order()) {
          by_order[q + kOrderStep].push_back(i);
        } else {
          near.push_back(i);
        }
      }
      counts.far += static_cast<Index>(group.targets.size());
      counts.far_nodes += static_cast<Index>(group.targets.size()) * group.rule.n_nodes();
      if (!group.targets.empty()) far.push_back(std::move(group));
    }
    std::sort(near.begin(), near.end());
    counts.near = static_cast<Index>(near.size());
  }

  [[nodiscard]] NearTarget locate(Index i) const {
    NearTarget target{i, nearest_foot(source, grid, nearest_nodes(grid, point(i)), point(i)), {}};
    if (!(target.foot.height > 0.0)) {
      throw ConvergenceError(fmt::format("({:.6g}, {:.6g}, {:.6g}) is not outside the membrane, by {:.3g}",
                                         points(i, 0), points(i, 1), points(i, 2), -target.foot.height));
    }
    target.rule = near_rule(target.foot, order, settings.tolerance, false);
    return target;
  }

  [[nodiscard]] NearRows rows_of(const NearTarget& target, const GradedRule& rule) const {
    const TargetFrame frame(fields, target.foot.theta, target.foot.phi);
    return near_rows(frame, rule, point(target.index) - target.foot.position, normal(target.index), columns);
  }

  /// Largest change of a row from one rule to another, relative to the largest entry of each layer.
  [[nodiscard]] static double change(const NearRows& a, const NearRows& b) {
    double largest = 0.0;
    for (Index c = 0; c < a.rows.rows(); ++c) {
      largest = std::max(largest, (a.rows.row(c) - b.rows.row(c)).cwiseAbs().maxCoeff() /
                                      std::max(b.rows.row(c).cwiseAbs().maxCoeff(), 1e-300));
    }
    return largest;
  }

  /// The first stage that agrees with the next at the targets that are nearest, farthest and between.
  [[nodiscard]] GradedRule settled_rule(const NearRule& choice, const std::vector<NearTarget>& group) const {
    std::vector<const NearTarget*> samples;
    for (const std::size_t i : {std::size_t{0}, group.size() / 2, group.size() - 1}) samples.push_back(&group[i]);
    samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
    GradedRule rule = make_near_rule(order, choice, 0);
    std::vector<NearRows> before;
    for (const NearTarget* sample : samples) before.push_back(rows_of(*sample, rule));
    for (int stage = 1; stage < settings.max_rules; ++stage) {
      rule = make_near_rule(order, choice, stage);
      double largest = 0.0;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        NearRows after = rows_of(*samples[i], rule);
        largest = std::max(largest, change(before[i], after));
        before[i] = std::move(after);
      }
      if (largest <= settings.tolerance) return rule;
    }
    const Index i = group.front().index;
    throw ConvergenceError(
        fmt::format("layers at ({:.6g}, {:.6g}, {:.6g}), {:.3g} from the membrane: the finest rules still disagree",
                    points(i, 0), points(i, 1), points(i, 2), group.front().foot.height));
  }

  void make_rows() {
    const Index n = static_cast<Index>(near.size());
    rows.resize(source.rows(), n * columns.count);
    std::vector<NearTarget> targets(near.size());
    std::vector<std::exception_ptr> exceptions(near.size());
    const auto guarded = [&exceptions](Index i, const auto& work) {
      try {
        work();
      } catch (...) {
        exceptions[i] = std::current_exception();
      }
    };
    const auto rethrow = [&exceptions] {
      for (const std::exception_ptr& exception : exceptions) {
        if (exception) std::rethrow_exception(exception);
      }
    };
#pragma omp parallel for schedule(dynamic, 1)
    for (Index i = 0; i < n; ++i) guarded(i, [&] { targets[i] = locate(near[i]); });
    rethrow();

    std::map<NearRule, std::vector<NearTarget>> groups;
    for (const NearTarget& target : targets) groups[target.rule].push_back(target);
    for (auto& [choice, group] : groups) {
      std::ranges::sort(group, {}, [](const NearTarget& t) { return std::pair(t.foot.height, t.index); });
      const GradedRule rule = settled_rule(choice, group);
      const std::vector<NearTarget>& members = group;  // OpenMP takes no structured binding
      const Index n_members = static_cast<Index>(members.size());
#pragma omp parallel for schedule(dynamic, 1)
      for (Index i = 0; i < n_members; ++i) {
        const Index place = std::lower_bound(near.begin(), near.end(), members[i].index) - near.begin();
        guarded(place, [&] {
          const NearRows found = rows_of(members[i], rule);
          // A solid angle that is off betrays another part of the membrane that no node has seen.
          constexpr double kEnclosureDefect = 1e-2;
          if (std::abs(found.enclosure) > kEnclosureDefect) {
            throw ConvergenceError(fmt::format("layers {:.3g} from the membrane: another part of it may be as near",
                                               members[i].foot.height));
          }
          rows.middleCols(place * columns.count, columns.count) = found.rows.transpose();
        });
      }
      rethrow();
    }
  }

  /// Rows of far targets as long as there is room, the finest grids first: theirs gain most.
  void make_far_rows() {
    by_rows = near;
    const double bytes_of_one = 8.0 * static_cast<double>(columns.count) * static_cast<double>(source.rows());
    double room = settings.row_bytes;
    std::vector<FarGroup> chosen;
    while (!far.empty() && static_cast<double>(far.back().targets.size()) * bytes_of_one <= room) {
      room -= static_cast<double>(far.back().targets.size()) * bytes_of_one;
      by_rows.insert(by_rows.end(), far.back().targets.begin(), far.back().targets.end());
      chosen.push_back(std::move(far.back()));
      far.pop_back();
    }
    rows.conservativeResize(Eigen::NoChange, static_cast<Index>(by_rows.size()) * columns.count);
    Index first = static_cast<Index>(near.size());
    for (const FarGroup& group : chosen) {
      fill_rows(group, first);
      first += static_cast<Index>(group.targets.size());
    }
  }

  void fill_rows(const FarGroup& group, Index first) {
    constexpr Index kBatch = 16;
    const Index n = static_cast<Index>(group.targets.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (Index start = 0; start < n; start += kBatch) {
      const Index size = std::min(kBatch, n - start);
      const std::vector<Index> batch(group.targets.begin() + start, group.targets.begin() + start + size);
      rows.middleCols((first + start) * columns.count, size * columns.count) =
          group.rule.rows(points(batch, Eigen::all), normals(batch, Eigen::all), columns);
    }
  }

  /// Every far target by its rule: `sum(rule, target, charges)`.
  template <class Values, class Sum>
  void add_far(const Matrix& density, Values& values, const Sum& sum) const {
    for (const FarGroup& group : far) {
      const Matrix charges = group.rule.charges(density);
      const Index n = static_cast<Index>(group.targets.size());
#pragma omp parallel for schedule(static)
      for (Index k = 0; k < n; ++k) {
        const Index i = group.targets[k];
        values.row(i) = sum(group.rule, i, charges);
      }
    }
  }

  static void require_selected(int column) {
    if (column < 0) throw std::logic_error("a layer between two membranes was not selected");
  }

  /// A scalar layer. @param column  of its rows
  template <class Sum>
  [[nodiscard]] Vector scalar(int column, const Vector& density, const Sum& sum) const {
    require_selected(column);
    require_size("density", density.size(), source.rows());
    Vector values(points.rows());
    add_far(density, values, [&sum](const FarRule& rule, Index i, const Matrix& charges) {
      return Eigen::Matrix<double, 1, 1>(sum(rule, i, charges));
    });
    const Index n = static_cast<Index>(by_rows.size());
#pragma omp parallel for schedule(static)
    for (Index k = 0; k < n; ++k) values[by_rows[k]] = rows.col(k * columns.count + column).dot(density.col(0));
    return values;
  }

  /// A Stokes layer. @param first  column of its blocks xx, xy, xz, yy, yz, zz
  template <class Sum>
  [[nodiscard]] Matrix stokes(int first, const Matrix& density, const Sum& sum) const {
    require_selected(first);
    require_size("density", density.rows(), source.rows());
    Matrix values(points.rows(), 3);
    add_far(density, values, [&sum](const FarRule& rule, Index i, const Matrix& charges) -> Eigen::RowVector3d {
      return sum(rule, i, charges).transpose();
    });
    constexpr int kBlock[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    const Index n = static_cast<Index>(by_rows.size());
#pragma omp parallel for schedule(static)
    for (Index k = 0; k < n; ++k) {
      const auto blocks = rows.middleCols(k * columns.count + first, 6);
      for (int i = 0; i < 3; ++i) {
        double value = 0.0;
        for (int j = 0; j < 3; ++j) value += blocks.col(kBlock[i][j]).dot(density.col(j));
        values(by_rows[k], i) = value;
      }
    }
    return values;
  }
};

PairLayers::PairLayers(const Matrix& source, const Matrix& points, const Matrix& normals,
                       const PairSelection& selection, const PairSettings& settings, Instruments& instruments) {
  require_size("points (Cartesian components)", points.cols(), 3);
  require_size("normals", normals.rows(), points.rows());
  const auto timer = instruments.time("pair layers");
  auto data = std::make_unique<Data>(source, points, normals, selection, settings);
  data->sort_targets();
  data->make_rows();
  data->make_far_rows();
  data_ = std::move(data);
}

PairLayers::~PairLayers() = default;
PairLayers::PairLayers(PairLayers&&) noexcept = default;
PairLayers& PairLayers::operator=(PairLayers&&) noexcept = default;

const PairCounts& PairLayers::counts() const { return data_->counts; }

Vector PairLayers::laplace_single(const Vector& weighted) const {
  return data_->scalar(data_->columns.single, weighted, [this](const FarRule& rule, Index i, const Matrix& charges) {
    return rule.laplace_single(data_->point(i), charges);
  });
}

Vector PairLayers::laplace_single_normal(const Vector& weighted) const {
  return data_->scalar(data_->columns.single_normal, weighted,
                       [this](const FarRule& rule, Index i, const Matrix& charges) {
                         return rule.laplace_single_normal(data_->point(i), data_->normal(i), charges);
                       });
}

Vector PairLayers::laplace_double(const Vector& density) const {
  return data_->scalar(data_->columns.double_layer, density,
                       [this](const FarRule& rule, Index i, const Matrix& charges) {
                         return rule.laplace_double(data_->point(i), charges);
                       });
}

Vector PairLayers::laplace_double_normal(const Vector& density) const {
  return data_->scalar(data_->columns.double_normal, density,
                       [this](const FarRule& rule, Index i, const Matrix& charges) {
                         return rule.laplace_double_normal(data_->point(i), data_->normal(i), charges);
                       });
}

Matrix PairLayers::stokes_single(const Matrix& weighted) const {
  return data_->stokes(data_->columns.stokes, weighted, [this](const FarRule& rule, Index i, const Matrix& charges) {
    return rule.stokes_single(data_->point(i), charges);
  });
}

Matrix PairLayers::stokes_double(const Matrix& velocity) const {
  return data_->stokes(data_->columns.stokes_double, velocity,
                       [this](const FarRule& rule, Index i, const Matrix& charges) {
                         return rule.stokes_double(data_->point(i), charges);
                       });
}

}  // namespace vehd

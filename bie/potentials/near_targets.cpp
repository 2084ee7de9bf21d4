#include "bie/potentials/near_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bie/potentials/near_rule.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// A target whose row is made of coefficients.
struct NearTarget {
  Index index = 0;
  FootPoint foot;
  NearRule rule;
};

/// What a group of targets is integrated by, with the rows of those by which that was found, ascending: these are of
/// the stage after it.
struct SettledRule {
  GradedRule rule;
  std::map<std::size_t, NearRows> rows;
  int stage = 0;
};

struct NearRowMaker {
  const PairGeometry& at;
  const PairColumns& columns;
  const NearRowSettings& settings;
  int order = order_of(at.source.rows());

  [[nodiscard]] std::vector<NearTarget> locate(const std::vector<Index>& targets) const {
    std::vector<NearestNodes> nearest;
    for (const Index i : targets) nearest.push_back(nearest_nodes(at.grid, at.point(i)));
    const std::vector<FootPoint> feet = nearest_feet(at.source, at.grid, nearest, at.points(targets, Eigen::all));
    std::vector<NearTarget> located;
    for (std::size_t k = 0; k < targets.size(); ++k) {
      if (!(feet[k].height > 0.0)) {
        const Vector3 x = at.point(targets[k]);
        throw ConvergenceError(fmt::format("({:.6g}, {:.6g}, {:.6g}) is not outside the membrane, by {:.3g}", x[0],
                                           x[1], x[2], -feet[k].height));
      }
      located.push_back({targets[k], feet[k], near_rule(feet[k], order, settings.tolerance, false)});
    }
    return located;
  }

  [[nodiscard]] TargetFrame frame_of(const NearTarget& target) const {
    return {at.fields, target.foot.theta, target.foot.phi};
  }
  [[nodiscard]] NearRows rows_of(const NearTarget& target, const TargetFrame& frame, const GradedRule& rule) const {
    return near_rows(frame, rule, at.point(target.index) - target.foot.position, at.normal(target.index), columns);
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

  /// The first stage with which the one after it agrees at the targets that are nearest, farthest and between.
  [[nodiscard]] SettledRule settled_rule(const NearRule& choice, const std::vector<NearTarget>& group) const {
    SettledRule settled{make_near_rule(order, choice, 0), {}, 0};
    std::vector<TargetFrame> frames;
    for (const std::size_t i : {std::size_t{0}, group.size() / 2, group.size() - 1}) {
      if (settled.rows.contains(i)) continue;
      frames.push_back(frame_of(group[i]));
      settled.rows.emplace(i, rows_of(group[i], frames.back(), settled.rule));
    }
    while (settled.stage + 1 < settings.max_rules) {
      GradedRule finer = make_near_rule(order, choice, settled.stage + 1);
      double largest = 0.0;
      auto frame = frames.begin();
      for (auto& [i, rows] : settled.rows) {
        NearRows after = rows_of(group[i], *frame++, finer);
        largest = std::max(largest, change(rows, after));
        rows = std::move(after);
      }
      if (largest <= settings.tolerance) return settled;
      settled.rule = std::move(finer);
      ++settled.stage;
    }
    const Index i = group.front().index;
    throw ConvergenceError(
        fmt::format("layers at ({:.6g}, {:.6g}, {:.6g}), {:.3g} from the membrane: the finest rules still disagree",
                    at.points(i, 0), at.points(i, 1), at.points(i, 2), group.front().foot.height));
  }

  /// By the settled rule, or by a finer one where D[1] says that this target, which was not asked, needs it.
  [[nodiscard]] NearRows rows_by(const SettledRule& settled, const NearTarget& target) const {
    const TargetFrame frame = frame_of(target);
    NearRows found = rows_of(target, frame, settled.rule);
    for (int stage = settled.stage + 1; std::abs(found.enclosure) > settings.tolerance && stage < settings.max_rules;
         ++stage) {
      NearRows finer = rows_of(target, frame, make_near_rule(order, target.rule, stage));
      // Rounding, or another part of the membrane that no rule about this point sees.
      if (!(std::abs(finer.enclosure) < 0.5 * std::abs(found.enclosure))) break;
      found = std::move(finer);
    }
    return found;
  }

  [[nodiscard]] Matrix rows(const std::vector<Index>& near) const {
    const Index n = static_cast<Index>(near.size());
    Matrix result(at.source.rows(), n * columns.count);
    Exceptions exceptions(n);
    // Targets that are looked for together: enough to fill registers, few enough for all threads to have some.
    constexpr Index kTogether = 16;
    const Index n_batches = (n + kTogether - 1) / kTogether;
    std::vector<std::vector<NearTarget>> batches(static_cast<std::size_t>(n_batches));
#pragma omp parallel for schedule(dynamic, 1)
    for (Index i = 0; i < n_batches; ++i) {
      exceptions.keep(i, [&] {
        batches[i] = locate({near.begin() + i * kTogether, near.begin() + std::min(n, (i + 1) * kTogether)});
      });
    }
    exceptions.rethrow_first();

    std::map<NearRule, std::vector<NearTarget>> groups;
    for (const std::vector<NearTarget>& batch : batches) {
      for (const NearTarget& target : batch) groups[target.rule].push_back(target);
    }
    for (auto& [choice, group] : groups) {
      std::ranges::sort(group, {}, [](const NearTarget& t) { return std::pair(t.foot.height, t.index); });
      const SettledRule settled = settled_rule(choice, group);
      const std::vector<NearTarget>& members = group;  // OpenMP takes no structured binding
      const Index n_members = static_cast<Index>(members.size());
#pragma omp parallel for schedule(dynamic, 1)
      for (Index i = 0; i < n_members; ++i) {
        const Index place = std::lower_bound(near.begin(), near.end(), members[i].index) - near.begin();
        exceptions.keep(place, [&] {
          const auto known = settled.rows.find(static_cast<std::size_t>(i));
          const NearRows found = known != settled.rows.end() ? known->second : rows_by(settled, members[i]);
          // A solid angle that is off betrays another part of the membrane that no node has seen.
          constexpr double kEnclosureDefect = 1e-2;
          if (std::abs(found.enclosure) > kEnclosureDefect) {
            throw ConvergenceError(fmt::format("layers {:.3g} from the membrane: another part of it may be as near",
                                               members[i].foot.height));
          }
          result.middleCols(place * columns.count, columns.count) = found.rows.transpose();
        });
      }
      exceptions.rethrow_first();
    }
    return result;
  }
};

}  // namespace

Matrix rows_of_near_targets(const PairGeometry& at, const std::vector<Index>& targets, const PairColumns& columns,
                            const NearRowSettings& settings) {
  return NearRowMaker{at, columns, settings}.rows(targets);
}

}  // namespace vehd

#include "bie/potentials/near_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>

#include "bie/potentials/near_rule.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// A target whose row is made of coefficients.
struct NearTarget {
  Index index = 0;
  FootPoint foot;
  NearRule rule;
};

/// What a group of targets is integrated by, with the rows of those by which that was found, ascending.
struct SettledRule {
  GradedRule rule;
  std::map<std::size_t, NearRows> rows;
};

struct NearRowMaker {
  const PairGeometry& at;
  const PairColumns& columns;
  const NearRowSettings& settings;
  int order = order_of(at.source.rows());

  [[nodiscard]] NearTarget locate(Index i) const {
    NearTarget target{i, nearest_foot(at.source, at.grid, nearest_nodes(at.grid, at.point(i)), at.point(i)), {}};
    if (!(target.foot.height > 0.0)) {
      throw ConvergenceError(fmt::format("({:.6g}, {:.6g}, {:.6g}) is not outside the membrane, by {:.3g}",
                                         at.points(i, 0), at.points(i, 1), at.points(i, 2), -target.foot.height));
    }
    target.rule = near_rule(target.foot, order, settings.tolerance, false);
    return target;
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

  /// The first stage that agrees with the one before it at the targets that are nearest, farthest and between: what it
  /// leaves is well below their difference, which is room for the targets that were not asked.
  [[nodiscard]] SettledRule settled_rule(const NearRule& choice, const std::vector<NearTarget>& group) const {
    SettledRule settled{make_near_rule(order, choice, 0), {}};
    std::vector<TargetFrame> frames;
    for (const std::size_t i : {std::size_t{0}, group.size() / 2, group.size() - 1}) {
      if (settled.rows.contains(i)) continue;
      frames.push_back(frame_of(group[i]));
      settled.rows.emplace(i, rows_of(group[i], frames.back(), settled.rule));
    }
    for (int stage = 1; stage < settings.max_rules; ++stage) {
      settled.rule = make_near_rule(order, choice, stage);
      double largest = 0.0;
      auto frame = frames.begin();
      for (auto& [i, rows] : settled.rows) {
        NearRows after = rows_of(group[i], *frame++, settled.rule);
        largest = std::max(largest, change(rows, after));
        rows = std::move(after);
      }
      if (largest <= settings.tolerance) return settled;
    }
    const Index i = group.front().index;
    throw ConvergenceError(
        fmt::format("layers at ({:.6g}, {:.6g}, {:.6g}), {:.3g} from the membrane: the finest rules still disagree",
                    at.points(i, 0), at.points(i, 1), at.points(i, 2), group.front().foot.height));
  }

  [[nodiscard]] Matrix rows(const std::vector<Index>& near) const {
    const Index n = static_cast<Index>(near.size());
    Matrix result(at.source.rows(), n * columns.count);
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
      const SettledRule settled = settled_rule(choice, group);
      const std::vector<NearTarget>& members = group;  // OpenMP takes no structured binding
      const Index n_members = static_cast<Index>(members.size());
#pragma omp parallel for schedule(dynamic, 1)
      for (Index i = 0; i < n_members; ++i) {
        const Index place = std::lower_bound(near.begin(), near.end(), members[i].index) - near.begin();
        guarded(place, [&] {
          const auto known = settled.rows.find(static_cast<std::size_t>(i));
          const NearRows found =
              known != settled.rows.end() ? known->second : rows_of(members[i], frame_of(members[i]), settled.rule);
          // A solid angle that is off betrays another part of the membrane that no node has seen.
          constexpr double kEnclosureDefect = 1e-2;
          if (std::abs(found.enclosure) > kEnclosureDefect) {
            throw ConvergenceError(fmt::format("layers {:.3g} from the membrane: another part of it may be as near",
                                               members[i].foot.height));
          }
          result.middleCols(place * columns.count, columns.count) = found.rows.transpose();
        });
      }
      rethrow();
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

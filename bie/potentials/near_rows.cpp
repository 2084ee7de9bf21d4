#include "bie/potentials/near_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/potentials/few_nodes.hpp"
#include "bie/potentials/foot_point.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

PairColumns::PairColumns(const PairSelection& selection) {
  const std::array selected{selection.laplace_single,        selection.laplace_single_normal, selection.laplace_double,
                            selection.laplace_double_normal, selection.stokes_single,         selection.stokes_double,
                            selection.no_slip_single,        selection.no_slip_double};
  for (std::size_t layer = 0; layer < n_pair_layers; ++layer) {
    first[layer] = selected[layer] ? count : -1;
    if (selected[layer]) count += n_rows(static_cast<PairLayer>(layer));
  }
}

namespace {

/// The factor of a kernel at a node: a density, its difference from that at the foot, or its tangential derivatives.
enum class NodeFactor { value, difference, tangents };

struct KernelKind {
  NodeFactor factor;
  double prefactor;
};

/// Factor and prefactor of every row.
std::vector<KernelKind> kinds_of(const PairColumns& columns) {
  constexpr std::array<KernelKind, n_pair_layers> kKinds{{{NodeFactor::value, kLaplacePrefactor},
                                                          {NodeFactor::value, kLaplacePrefactor},
                                                          {NodeFactor::difference, kLaplacePrefactor},
                                                          {NodeFactor::tangents, kLaplacePrefactor},
                                                          {NodeFactor::value, stokes_single_layer_prefactor(1.0)},
                                                          {NodeFactor::difference, kStokesDoubleLayerPrefactor},
                                                          {NodeFactor::value, stokes_single_layer_prefactor(1.0)},
                                                          {NodeFactor::difference, kStokesDoubleLayerPrefactor}}};
  std::vector<KernelKind> kinds;
  for (std::size_t layer = 0; layer < n_pair_layers; ++layer) {
    if (columns.first[layer] < 0) continue;
    kinds.insert(kinds.end(), static_cast<std::size_t>(n_rows(static_cast<PairLayer>(layer))), kKinds[layer]);
  }
  return kinds;
}

/// Kernels times weights on one circle of nodes, [columns + 1 x n_theta]: the last row is for the second tangent in the
/// normal derivative of D. @return ∫ r·J n/|r|³ of the circle
double circle_kernels(const NodeColumns& at, const double* nodes, const Vector& weight, const Vector3& offset,
                      const Vector3& normal, const MirroredTarget& mirrored, const PairColumns& columns,
                      double* kernels) {
  const Index n = weight.size();
  const auto field = [&](int column, Index i) { return few(nodes + column * n + i); };
  const auto dot = [](const Vector3& a, const Few& x, const Few& y, const Few& z) -> Few {
    return a[0] * x + a[1] * y + a[2] * z;
  };
  double angle = 0.0;
  for (Index next = 0; next < n; next += kTogether) {
    // The last register begins earlier, so that it ends with the circle, and recomputes some nodes of the one before.
    const Index i = std::min(next, n - kTogether);
    const auto put = [&](int row, const Few& values) { store(kernels + row * n + i, values); };
    const Few x = offset[0] - field(at.position, i), y = offset[1] - field(at.position + 1, i),
              z = offset[2] - field(at.position + 2, i);
    const Few ux = field(at.tangent_1, i), uy = field(at.tangent_1 + 1, i), uz = field(at.tangent_1 + 2, i);
    const Few vx = field(at.tangent_2, i), vy = field(at.tangent_2 + 1, i), vz = field(at.tangent_2 + 2, i);
    const Few inverse = inverse_root(x * x + y * y + z * z);
    const Few w = few(weight.data() + i);
    const Few area = x * (uy * vz - uz * vy) + y * (uz * vx - ux * vz) + z * (ux * vy - uy * vx);  // r·(u × v)
    const Few solid_angle = w * laplace_double_kernel(area, inverse);
    angle += sum(solid_angle, next - i);
    const auto put_blocks = [&](PairLayer layer, const std::array<Few, 6>& blocks) {
      for (int k = 0; k < 6; ++k) put(columns[layer] + k, w * blocks[static_cast<std::size_t>(k)]);
    };
    using enum PairLayer;
    if (columns.has(laplace_single)) put(columns[laplace_single], w * laplace_single_kernel(inverse));
    if (columns.has(laplace_single_normal)) {
      put(columns[laplace_single_normal], w * laplace_adjoint_kernel(dot(normal, x, y, z), inverse));
    }
    if (columns.has(laplace_double)) put(columns[laplace_double], solid_angle);
    if (columns.has(laplace_double_normal)) {
      // −N·r/|r|³ × (f_1 v − f_2 u)
      const Few factor = w * inverse * inverse * inverse;
      put(columns[laplace_double_normal], -factor * dot(normal, y * vz - z * vy, z * vx - x * vz, x * vy - y * vx));
      put(columns.count, factor * dot(normal, y * uz - z * uy, z * ux - x * uz, x * uy - y * ux));
    }
    if (columns.has(stokes_single)) put_blocks(stokes_single, stokeslet(x, y, z, inverse));
    if (columns.has(stokes_double)) put_blocks(stokes_double, stokes_double_kernel(x, y, z, area, inverse));
    // One column of the kernel at a time.
    const auto put_image = [&](PairLayer layer, const auto& flow) {
      for (int column = 0; column < 3; ++column) {
        const auto force = [column](int component) { return Few{} + (component == column ? 1.0 : 0.0); };
        const std::array<Few, 3> values = flow(force(0), force(1), force(2));
        for (int row = 0; row < 3; ++row) {
          put(columns[layer] + row_of_block(layer, row, column), w * values[static_cast<std::size_t>(row)]);
        }
      }
    };
    if (columns.has(no_slip_single)) {
      put_image(no_slip_single, [&](const Few& fx, const Few& fy, const Few& fz) {
        return no_slip_flow(mirrored, x, y, z, inverse, fx, fy, fz);
      });
    }
    if (columns.has(no_slip_double)) {
      const Few ax = uy * vz - uz * vy, ay = uz * vx - ux * vz, az = ux * vy - uy * vx;
      put_image(no_slip_double, [&](const Few& fx, const Few& fy, const Few& fz) {
        return no_slip_double_flow(mirrored, x, y, z, inverse, ax, ay, az, fx, fy, fz);
      });
    }
  }
  return angle;
}

}  // namespace

NearRows near_rows(const TargetFrame& frame, const GradedRule& rule, const Vector3& offset, const Vector3& normal,
                   const MirroredTarget& mirrored, const PairColumns& columns) {
  const Index n_theta = rule.theta.size();
  const Index n_all = columns.count + 1;
  const RowMatrix nodes = frame.nodes(rule);
  RowMatrix kernels = RowMatrix::Zero(rule.n_phi, filled_up(n_all * n_theta));
  NearRows result;
  for (int k = 0; k < rule.n_phi; ++k) {
    result.enclosure += kLaplacePrefactor * circle_kernels(NodeColumns{}, nodes.row(k).data(), rule.weight, offset,
                                                           normal, mirrored, columns, kernels.row(k).data());
  }
  // Adjoint of the Fourier sums, then of the Legendre sums of each m.
  const RowMatrix circles = rule.azimuths.adjoint(kernels);
  const std::vector<KernelKind> kinds = kinds_of(columns);
  const int order = static_cast<int>(rule.synthesis.size()) - 1;
  std::vector<RowMatrix> rotated;
  for (int m = 0; m <= order; ++m) {
    const RowMatrix& table = rule.adjoint[m];
    const Index width = table.cols();
    RowMatrix part = RowMatrix::Zero(2 * columns.count, width);
    Eigen::RowVectorXd tangent(width);
    // Legendre sums of `count` columns from one Fourier mode of the circles, with one kind of table.
    const auto sum_circles = [&](Index kind, Index mode, Index column, Index count, double* to) {
      small_product(count, n_theta, width, {circles.row(mode).data() + column * n_theta, n_theta, 1},
                    table.data() + kind * n_theta * width, width, to, width);
    };
    sum_circles(0, m, 0, columns.count, part.data());
    if (m > 0) sum_circles(0, order + m, 0, columns.count, part.row(columns.count).data());
    for (int c = 0; c < columns.count; ++c) {
      auto cosine = part.row(c);
      auto sine = part.row(columns.count + c);
      if (kinds[c].factor == NodeFactor::tangents) {
        sum_circles(1, m, c, 1, cosine.data());
        if (m > 0) {
          sum_circles(1, order + m, c, 1, sine.data());
          sum_circles(2, order + m, columns.count, 1, tangent.data());
          cosine -= tangent;
          sum_circles(2, m, columns.count, 1, tangent.data());
          sine += tangent;
        }
      }
      if (m == 0 && kinds[c].factor == NodeFactor::value) {
        // The tables hold differences from the pole.
        const double sum = circles.row(m).segment(c * n_theta, n_theta).sum();
        for (int n = 0; n <= order; ++n) cosine[n] += std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi)) * sum;
      }
      cosine *= kinds[c].prefactor;
      sine *= kinds[c].prefactor;
    }
    rotated.push_back(std::move(part));
  }
  result.rows = frame.rotated_back(rotated);
  return result;
}

namespace {

/// A target that is evaluated by a row over coefficients.
struct NearTarget {
  Index index = 0;
  FootPoint foot;
  NearRule rule;
};

/// The rule for a group of targets, with the rows of the targets that it was tested at, by the stage after it.
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
        throw ConvergenceError(fmt::format("({:.6g}, {:.6g}, {:.6g}) lies inside the membrane, at a depth of {:.3g}",
                                           x[0], x[1], x[2], -feet[k].height));
      }
      located.push_back({targets[k], feet[k], near_rule(feet[k], order, settings.tolerance, false)});
    }
    return located;
  }

  [[nodiscard]] TargetFrame frame_of(const NearTarget& target) const {
    return {at.fields, target.foot.theta, target.foot.phi};
  }
  [[nodiscard]] NearRows rows_of(const NearTarget& target, const TargetFrame& frame, const GradedRule& rule) const {
    const Vector3 x = at.point(target.index);
    return near_rows(frame, rule, x - target.foot.position, at.normal(target.index), at.plane.target(x), columns);
  }

  /// Largest change of an entry from one rule to another, relative to the largest entry of its row.
  [[nodiscard]] static double change(const NearRows& a, const NearRows& b) {
    double largest = 0.0;
    for (Index c = 0; c < a.rows.rows(); ++c) {
      largest = std::max(largest, (a.rows.row(c) - b.rows.row(c)).cwiseAbs().maxCoeff() /
                                      std::max(b.rows.row(c).cwiseAbs().maxCoeff(), 1e-300));
    }
    return largest;
  }

  /// The first stage that agrees with the one after it at the nearest, a middle and the farthest target.
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

  /// Rows by the settled rule, or by a finer one if D[1] shows that this target, which was not tested, needs it.
  [[nodiscard]] NearRows rows_by(const SettledRule& settled, const NearTarget& target) const {
    const TargetFrame frame = frame_of(target);
    NearRows found = rows_of(target, frame, settled.rule);
    for (int stage = settled.stage + 1; std::abs(found.enclosure) > settings.tolerance && stage < settings.max_rules;
         ++stage) {
      NearRows finer = rows_of(target, frame, make_near_rule(order, target.rule, stage));
      // Rounding, or another part of the membrane that no rule about this point resolves.
      if (!(std::abs(finer.enclosure) < 0.5 * std::abs(found.enclosure))) break;
      found = std::move(finer);
    }
    return found;
  }

  [[nodiscard]] Matrix rows(const std::vector<Index>& near) const {
    const Index n = static_cast<Index>(near.size());
    Matrix result(at.source.rows(), n * columns.count);
    Exceptions exceptions(n);
    // Targets located together: enough to fill registers, few enough to give work to all threads.
    constexpr Index kTargetsTogether = 16;
    const Index n_batches = (n + kTargetsTogether - 1) / kTargetsTogether;
    std::vector<std::vector<NearTarget>> batches(static_cast<std::size_t>(n_batches));
#pragma omp parallel for schedule(dynamic, 1)
    for (Index i = 0; i < n_batches; ++i) {
      exceptions.keep(i, [&] {
        batches[i] =
            locate({near.begin() + i * kTargetsTogether, near.begin() + std::min(n, (i + 1) * kTargetsTogether)});
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
          // A wrong solid angle indicates another part of the membrane that the nodes do not resolve.
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

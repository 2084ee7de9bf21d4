#include "bie/stepping/solve/tension_solve.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/physics/tension.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/solve/sphere_spectrum.hpp"
#include "bie/stepping/solve/tension_inverse.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Two scalars on one membrane: c and λ as unknowns, u·n and J ∇_γ·u as what they have to make vanish. Those that a
/// membrane does not have are empty.
struct ScalarPair {
  Vector normal, tension;
};

template <MaybeConst<ScalarPair> Pair, typename Visit>
void visit_members(Pair& pair, Visit& visit) {
  visit(pair.normal, pair.tension);
}

/// The problem on one membrane.
class OneTension {
 public:
  /// @param holds_shape  whether a sphere is kept one by forces along its normal
  OneTension(const FlowMembrane& one, bool is_sphere, bool holds_shape)
      : one_(one),
        membrane_(one.membrane),
        inextensible_(one.parameters.inextensible),
        is_sphere_(is_sphere),
        holds_shape_(is_sphere && holds_shape),
        mean_response_(
            uniform_tension_response(one.membrane.radius, one.parameters.viscosity, one.parameters.viscosity_ratio)) {
    const SphereFlow sphere{membrane_.radius, one.parameters.viscosity, 0.0, 0.0, one.parameters.viscosity_ratio};
    const int order = membrane_.fine.order();
    inverse_.resize(n_coefficients(order), 4);
    for (int n = 0; n <= order; ++n) {
      Eigen::Matrix2d block = Eigen::Matrix2d::Identity();
      if (is_held(n)) {
        block = rigid_sphere_block(sphere, n);
      } else {
        block(1, 1) = n == 0 ? mean_response_ : sphere_flow_block(sphere, n)(1, 1);
      }
      const Eigen::Matrix2d inverse = block.inverse();
      auto of_degree = inverse_.middleRows(coefficient_index(n, -n), 2 * n + 1);
      of_degree.rowwise() = Eigen::RowVector4d(inverse(0, 0), inverse(0, 1), inverse(1, 0), inverse(1, 1));
    }
  }

  /// What approximate_inverse goes by from now on, unless it is a sphere.
  void find_inverse(const TensionGrid& grid) {
    if (is_sphere_ || !inextensible_) return;
    of_membrane_.emplace(one_, grid, tension_entries(), mean_response_);
  }

  [[nodiscard]] const Membrane& membrane() const { return membrane_; }
  [[nodiscard]] std::vector<Index> normal_entries() const {
    std::vector<Index> entries;
    for (const Index i : membrane_.subspace.scalars()) {
      if (is_held(degree_of(i))) entries.push_back(i);
    }
    return entries;
  }
  /// Is there a force c n of this degree? Of the highest one truncation leaves a single velocity, which λ rules alone:
  /// its harmonic V is of one degree more.
  [[nodiscard]] bool is_held(int degree) const {
    return holds_shape_ && degree >= 2 && degree < membrane_.fine.order();
  }
  [[nodiscard]] std::vector<Index> tension_entries() const {
    return inextensible_ ? membrane_.subspace.scalars() : std::vector<Index>();
  }

  /// Force on the fluid; empty where there is none.
  [[nodiscard]] Matrix force(const ScalarPair& unknowns) const {
    if (!inextensible_) return {};
    Matrix result = tension_force(membrane_, unknowns.tension);
    if (holds_shape_) {
      const Matrix normal = Vector(membrane_.fine.synthesize(unknowns.normal)).asDiagonal() * membrane_.surface.normal;
      result += without_mean(normal);
    }
    return result;
  }

  /// u·n and J ∇_γ·u.
  [[nodiscard]] ScalarPair constraints(const Matrix& velocity) const {
    const SphereDerivatives u = membrane_.fine.synthesize_first_derivatives(velocity);
    ScalarPair result{Vector::Zero(velocity.rows()), weighted_divergence(membrane_, u)};
    if (is_sphere_) result.tension[0] = 0.0;
    if (holds_shape_) {
      const Matrix moving = without_mean(membrane_.fine.synthesize(velocity));
      result.normal = membrane_.fine.analyze(moving.cwiseProduct(membrane_.surface.normal).rowwise().sum());
    }
    return result;
  }

  /// The same of the velocity that the unknowns make; a uniform tension of a sphere, which makes none, stays zero.
  [[nodiscard]] ScalarPair response(const Matrix& velocity, const ScalarPair& unknowns) const {
    ScalarPair result = constraints(velocity);
    if (is_sphere_) result.tension[0] = mean_response_ * unknowns.tension[0];
    return result;
  }

  [[nodiscard]] ScalarPair approximate_inverse(const ScalarPair& residual) const {
    if (of_membrane_) {
      const std::vector<Index> entries = tension_entries();
      ScalarPair of_all = residual;
      of_all.tension(entries) = of_membrane_->apply(residual.tension(entries));
      return of_all;
    }
    if (!holds_shape_) return {residual.normal, inverse_.col(3).cwiseProduct(residual.tension)};
    return {inverse_.col(0).cwiseProduct(residual.normal) + inverse_.col(1).cwiseProduct(residual.tension),
            inverse_.col(2).cwiseProduct(residual.normal) + inverse_.col(3).cwiseProduct(residual.tension)};
  }

 private:
  /// Degrees of c and u·n are those of the parameter sphere, so on points that have flowed degrees from 2 on have a
  /// part of degree 1 in space. Without the mean they neither hold a translation nor exert a net force.
  [[nodiscard]] Matrix without_mean(const Matrix& values) const {
    return values.rowwise() - surface_mean(membrane_.surface, values).transpose();
  }

  const FlowMembrane& one_;
  const Membrane& membrane_;
  bool inextensible_, is_sphere_, holds_shape_;
  double mean_response_;
  Eigen::Matrix<double, Eigen::Dynamic, 4> inverse_;  ///< of a sphere, row by row for each coefficient
  std::optional<TensionInverse> of_membrane_;
};

/// The scalars of all membranes as one vector: normal forces, behind them tensions.
class Layout {
 public:
  explicit Layout(const std::vector<OneTension>& all)
      : normal_(stacked(all, &OneTension::normal_entries)), tension_(stacked(all, &OneTension::tension_entries)) {}

  [[nodiscard]] Index size() const { return normal_.size() + tension_.size(); }

  [[nodiscard]] Vector stack(const std::vector<ScalarPair>& scalars) const {
    std::vector<Vector> normal, tension;
    for (const ScalarPair& of_one : scalars) {
      normal.push_back(of_one.normal);
      tension.push_back(of_one.tension);
    }
    Vector result(size());
    result << normal_.stack(normal), tension_.stack(tension);
    return result;
  }

  [[nodiscard]] std::vector<ScalarPair> scalars(const Vector& stacked) const {
    const std::vector<Vector> normal = normal_.parts(stacked.head(normal_.size()));
    const std::vector<Vector> tension = tension_.parts(stacked.tail(tension_.size()));
    std::vector<ScalarPair> result;
    for (std::size_t a = 0; a < normal.size(); ++a) result.push_back({normal[a], tension[a]});
    return result;
  }

  /// Of membranes without normal forces: what is known of each of its rows, as rows of all. Nothing where one has
  /// something else.
  [[nodiscard]] RecycledSubspace joined(const std::vector<RecycledSubspace>& of_each, const Vector& scales) const {
    const Index count = of_each.front().count();
    RecycledSubspace result{Matrix(size(), count), Matrix(size(), count)};
    for (std::size_t a = 0; a < of_each.size(); ++a) {
      const Index first = tension_.first_of(a), n = tension_.count_of(a);
      if (of_each[a].count() != count || of_each[a].arguments.rows() != n) return {};
      result.arguments.middleRows(first, n) = of_each[a].arguments;
      result.responses.middleRows(first, n) = of_each[a].responses;
    }
    result.arguments = scales.cwiseInverse().asDiagonal() * result.arguments;
    return result;
  }

  /// The other way.
  [[nodiscard]] std::vector<RecycledSubspace> of_each(const RecycledSubspace& all, const Vector& scales) const {
    const Matrix arguments = scales.asDiagonal() * all.arguments;
    std::vector<RecycledSubspace> result;
    for (std::size_t a = 0; a < tension_.n_parts(); ++a) {
      const Index first = tension_.first_of(a), n = tension_.count_of(a);
      result.push_back({arguments.middleRows(first, n), all.responses.middleRows(first, n)});
    }
    return result;
  }

  /// The uniform parts of the tensions left out.
  [[nodiscard]] Vector without_means(Vector stacked) const {
    for (std::size_t a = 0; a < tension_.n_parts(); ++a) {
      if (tension_.count_of(a) > 0) stacked[normal_.size() + tension_.first_of(a)] = 0.0;
    }
    return stacked;
  }

  /// c and λ over their scales, which are alike for membranes of any size.
  [[nodiscard]] Vector scales(const std::vector<OneTension>& all) const {
    std::vector<double> radii;
    for (const OneTension& one : all) radii.push_back(one.membrane().radius);
    Vector result(size());
    result << Vector::Ones(normal_.size()), tension_.spread(radii);
    return result;
  }

 private:
  using Entries = std::vector<Index> (OneTension::*)() const;
  static StackedEntries stacked(const std::vector<OneTension>& all, Entries entries_of) {
    std::vector<Index> sizes;
    std::vector<std::vector<Index>> entries;
    for (const OneTension& one : all) {
      sizes.push_back(n_coefficients(one.membrane().fine.order()));
      entries.push_back((one.*entries_of)());
    }
    return {std::move(sizes), std::move(entries)};
  }

  StackedEntries normal_, tension_;
};

/// Velocities on the membranes of this rank as one vector.
class OwnVelocities {
 public:
  OwnVelocities(const std::vector<OneTension>& all, const std::vector<std::size_t>& own) : n_(all.size()), own_(own) {
    for (const std::size_t a : own_) rows_.push_back(n_coefficients(all[a].membrane().fine.order()));
  }

  [[nodiscard]] Index size() const { return 3 * std::accumulate(rows_.begin(), rows_.end(), Index{0}); }

  [[nodiscard]] Vector stack(const std::vector<Matrix>& velocities) const {
    Vector result(size());
    Index first = 0;
    for (std::size_t i = 0; i < own_.size(); ++i) {
      result.segment(first, 3 * rows_[i]) = velocities[own_[i]].reshaped();
      first += 3 * rows_[i];
    }
    return result;
  }

  /// The other way; those of others are empty.
  [[nodiscard]] std::vector<Matrix> velocities(const Vector& stacked) const {
    std::vector<Matrix> result(n_);
    Index first = 0;
    for (std::size_t i = 0; i < own_.size(); ++i) {
      result[own_[i]] = stacked.segment(first, 3 * rows_[i]).reshaped(rows_[i], 3);
      first += 3 * rows_[i];
    }
    return result;
  }

 private:
  std::size_t n_;
  std::vector<std::size_t> own_;
  std::vector<Index> rows_;
};

/// Preconditioners of many membranes, of those of this rank.
void find_inverses(std::vector<OneTension>& all, const std::vector<std::size_t>& own) {
  std::map<int, TensionGrid> grids;
  for (const std::size_t a : own) {
    const int order = all[a].membrane().fine.order();
    if (!grids.contains(order)) grids.emplace(order, order);
  }
  for_each_member(own, [&](std::size_t a) { all[a].find_inverse(grids.at(all[a].membrane().fine.order())); });
}

/// Adds J f_λ (and J c n on spheres) of the membranes of this rank.
void add_forces(const std::vector<OneTension>& all, const std::vector<std::size_t>& own,
                const std::vector<ScalarPair>& unknowns, std::vector<Matrix>& weighted) {
  for_each_member(own, [&](std::size_t a) {
    const Matrix force = all[a].force(unknowns[a]);
    if (force.size() == 0) return;
    const Matrix of_tension = all[a].membrane().weighted(force);
    weighted[a] = weighted[a].size() == 0 ? of_tension : Matrix(weighted[a] + of_tension);
  });
}

}  // namespace

SolvedTensions solve_tensions(const std::vector<FlowMembrane>& membranes, const std::vector<bool>& is_sphere,
                              MembraneFlow& flow, std::vector<Matrix> weighted, const std::vector<Matrix>& background,
                              const std::vector<Vector>& start, const std::vector<RecycledSubspace>& known,
                              double tolerance) {
  std::vector<OneTension> all;
  const bool has_others = membranes.size() > 1;
  for (std::size_t a = 0; a < membranes.size(); ++a) all.emplace_back(membranes[a], is_sphere[a], has_others);
  const std::vector<std::size_t> own = flow.shares().own(all.size());
  const auto gather = [&flow](std::vector<ScalarPair>& scalars) {
    flow.shares().gather(scalars, [&flow](const ScalarPair& of_original, std::size_t a) -> ScalarPair {
      const ImageOfFields& image = flow.exchange().image(a);
      return {image.scalar(of_original.normal), image.scalar(of_original.tension)};
    });
  };
  const bool many = are_many(static_cast<Index>(all.size()));
  if (many) find_inverses(all, own);
  const Layout layout(all);
  const Vector scales = layout.scales(all);
  const OwnVelocities of_own(all, own);
  const LinearMap map = [&](const Vector& v) {
    const std::vector<ScalarPair> unknowns = layout.scalars(v.cwiseProduct(scales));
    std::vector<Matrix> of_tensions(all.size());
    add_forces(all, own, unknowns, of_tensions);
    const std::vector<Matrix> velocities = flow.velocities(of_tensions);
    std::vector<ScalarPair> result(all.size());
    for_each_member(own, [&](std::size_t a) { result[a] = all[a].response(velocities[a], unknowns[a]); });
    gather(result);
    // The velocities go along: those of the solution are then known without another application.
    Vector response(layout.size() + of_own.size());
    response << layout.stack(result), of_own.stack(velocities);
    return response;
  };
  const LinearMap preconditioner = [&](const Vector& residual) -> Vector {
    std::vector<ScalarPair> parts = layout.scalars(residual);
    // Those of spheres, which few membranes have, every rank has for all.
    if (many) {
      for_each_member(own, [&](std::size_t a) { parts[a] = all[a].approximate_inverse(parts[a]); });
      gather(parts);
    } else {
      for (std::size_t a = 0; a < all.size(); ++a) parts[a] = all[a].approximate_inverse(parts[a]);
    }
    return layout.stack(parts).cwiseQuotient(scales);
  };
  std::vector<ScalarPair> guess;
  for (std::size_t a = 0; a < all.size(); ++a) {
    const Vector none = Vector::Zero(n_coefficients(all[a].membrane().fine.order()));
    guess.push_back({none, start[a].size() > 0 ? start[a] : none});
    // The mean does nothing on a sphere, and is none of the unknowns' business.
    if (is_sphere[a]) guess.back().tension[0] = 0.0;
  }
  add_forces(all, own, guess, weighted);
  const std::vector<Matrix> before = flow.velocities(weighted, background);
  std::vector<ScalarPair> left(all.size());
  for (const std::size_t a : own) left[a] = all[a].constraints(-before[a]);
  gather(left);
  const bool recycles = !many && std::ranges::count(is_sphere, true) == 0;
  const RecycledSubspace former = recycles ? layout.joined(known, scales) : RecycledSubspace{};
  RecycledGcr solver(map, preconditioner, layout.size(), of_own.size(), former);
  const Vector first = layout.stack(guess).cwiseQuotient(scales), rhs = layout.stack(left);
  RecycledGcr::Solution solution;
  int iterations = 0;
  // A start that was much larger than the solution says nothing of the tensions: then they do themselves.
  for (double size = layout.without_means(first).norm();;) {
    solution = solver.solve(rhs, {}, {tolerance, thresholds::most_flow_iterations}, size);
    iterations += solution.report.iterations;
    const double found = layout.without_means(first + solution.x).norm();
    if (!solution.report.converged() || size <= 2.0 * found || size <= solution.size_of_rhs) break;
    size = found;
  }
  solution.report.iterations = iterations;
  SolvedTensions result{{}, {}, {}, std::vector<RecycledSubspace>(all.size()), solution.report};
  if (recycles) {
    const RecycledSubspace learned =
        joined(solver.learned(), selected(former, solver.kept()), thresholds::most_recycled);
    if (learned.count() > 0) result.learned = layout.of_each(learned, scales);
  }
  const std::vector<ScalarPair> unknowns = layout.scalars((first + solution.x).cwiseProduct(scales));
  result.velocities = of_own.velocities(of_own.stack(before) + solution.further);
  for (std::size_t a = 0; a < all.size(); ++a) {
    result.tension.push_back(membranes[a].parameters.inextensible ? unknowns[a].tension : Vector());
    result.force.push_back(flow.shares().owns(a) ? all[a].force(unknowns[a]) : Matrix());
  }
  return result;
}

}  // namespace vehd

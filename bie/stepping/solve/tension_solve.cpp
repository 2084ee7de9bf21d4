#include "bie/stepping/solve/tension_solve.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/physics/effects/tension.hpp"
#include "bie/physics/effects/undulations.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/solve/sphere_spectrum.hpp"
#include "bie/stepping/solve/tension_inverse.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// The problem on one membrane. Its unknowns are the coefficients that can differ from zero: of c where a force c n
/// holds a sphere in shape, and after them of λ. Residuals u·n and J ∇_γ·u have the same entries. With undulations the
/// mean of λ is known from the area, and the first coefficient of λ stands for the dilation e = ∇_γ·u, times μR.
class OneTension {
 public:
  /// @param holds_shape  whether a sphere is kept one by forces along its normal
  OneTension(const FlowMembrane& one, bool is_sphere, bool holds_shape)
      : one_(one),
        membrane_(one.membrane),
        is_sphere_(is_sphere),
        mean_response_(
            uniform_tension_response(one.membrane.radius, one.parameters.viscosity, one.parameters.viscosity_ratio)) {
    if (!one.parameters.inextensible) return;
    tension_ = membrane_.subspace.scalars();
    if (one.parameters.undulations) {
      mean_tension_ = AreaLaw(*one.parameters.undulations).tension(surface_area(membrane_.surface));
      const double per_dilation = -1.0 / (one.parameters.viscosity * membrane_.radius);
      const Vector area_element = membrane_.weighted(Vector::Ones(membrane_.surface.n_points()));
      of_dilation_ = per_dilation * area_element(tension_);
    }
    const int order = membrane_.fine.order();
    // Of the highest degree truncation leaves a single velocity, which λ rules alone: its harmonic V is of one degree
    // more.
    const auto is_held = [&](int n) { return is_sphere && holds_shape && n >= 2 && n < order; };
    const SphereFlow sphere{membrane_.radius, one.parameters.viscosity, 0.0, 0.0, one.parameters.viscosity_ratio};
    Matrix inverse(order + 1, 4);
    for (int n = 0; n <= order; ++n) {
      Eigen::Matrix2d block = Eigen::Matrix2d::Identity();
      if (is_held(n)) {
        block = rigid_sphere_block(sphere, n);
      } else {
        block(1, 1) = n == 0 ? first_response() : sphere_flow_block(sphere, n)(1, 1);
      }
      inverse.row(n) = block.inverse().reshaped<Eigen::RowMajor>().transpose();
    }
    std::vector<int> degrees;
    for (const Index i : tension_) {
      degrees.push_back(degree_of(i));
      if (is_held(degrees.back())) normal_.push_back(i);
    }
    inverse_ = inverse(degrees, Eigen::all);
    if (!normal_.empty()) first_held_ = std::ranges::find(tension_, normal_.front()) - tension_.begin();
  }

  /// What approximate_inverse goes by from now on, unless it is a sphere.
  void find_inverse(const TensionGrid& grid) {
    if (is_sphere_ || tension_.empty() || mean_tension_) return;
    of_membrane_.emplace(one_, grid, tension_, mean_response_);
  }

  [[nodiscard]] const Membrane& membrane() const { return membrane_; }
  [[nodiscard]] Index size() const { return n_normal() + n_tension(); }
  [[nodiscard]] Index n_normal() const { return std::ssize(normal_); }

  /// λ and, where there is one, c: coefficients, [n_coefficients x 1 or 2].
  [[nodiscard]] Matrix fields(const Vector& unknowns) const {
    Matrix result = Matrix::Zero(n_coefficients(membrane_.fine.order()), normal_.empty() ? 1 : 2);
    result.col(0)(tension_) = unknowns.tail(n_tension());
    if (!normal_.empty()) result.col(1)(normal_) = unknowns.head(n_normal());
    return result;
  }
  /// The other way.
  [[nodiscard]] Vector unknowns(const Matrix& fields) const {
    Vector result(size());
    result.tail(n_tension()) = fields.col(0)(tension_);
    if (!normal_.empty()) result.head(n_normal()) = fields.col(1)(normal_);
    return result;
  }
  /// Those of a tension to start from; c, and the mean on a sphere, which does nothing there, are zero.
  [[nodiscard]] Vector guess(const Vector& tension) const {
    Vector result = Vector::Zero(size());
    if (tension.size() > 0) result.tail(n_tension()) = tension(tension_);
    if (is_sphere_ || mean_tension_) result[n_normal()] = 0.0;
    return result;
  }
  /// λ, coefficients; empty where the membrane may extend.
  [[nodiscard]] Vector tension(const Vector& unknowns) const {
    if (tension_.empty()) return {};
    return tension_of(fields(unknowns), mean_tension_.value_or(0.0));
  }

  /// Force on the fluid; empty where there is none.
  /// @param whole  with the force of a mean tension that is known, which depends on no unknown
  [[nodiscard]] Matrix force(const Vector& unknowns, bool whole) const {
    if (tension_.empty()) return {};
    const Matrix of_all = fields(unknowns);
    Matrix result = tension_force(membrane_, tension_of(of_all, whole ? mean_tension_.value_or(0.0) : 0.0));
    if (!normal_.empty()) {
      const Matrix normal = Vector(membrane_.fine.synthesize(of_all.col(1))).asDiagonal() * membrane_.surface.normal;
      result += without_mean(normal);
    }
    return result;
  }

  /// u·n and J ∇_γ·u.
  [[nodiscard]] Vector constraints(const Matrix& velocity) const {
    if (tension_.empty()) return {};
    const SphereDerivatives u = membrane_.fine.synthesize_first_derivatives(velocity);
    const Vector divergence = weighted_divergence(membrane_, u);
    Vector result(size());
    result.tail(n_tension()) = divergence(tension_);
    if (is_sphere_) result[n_normal()] = 0.0;
    if (!normal_.empty()) {
      const Matrix moving = without_mean(membrane_.fine.synthesize(velocity));
      const Vector along = membrane_.fine.analyze(moving.cwiseProduct(membrane_.surface.normal).rowwise().sum());
      result.head(n_normal()) = along(normal_);
    }
    return result;
  }

  /// The same of the velocity that the unknowns make, J (∇_γ·u − e) where the area is free; a uniform tension of a
  /// sphere, which makes none, stays zero.
  [[nodiscard]] Vector response(const Matrix& velocity, const Vector& unknowns) const {
    Vector result = constraints(velocity);
    if (mean_tension_) result += unknowns[0] * of_dilation_;
    if (is_sphere_) result[n_normal()] = mean_response_ * unknowns[n_normal()];
    return result;
  }

  [[nodiscard]] Vector approximate_inverse(const Vector& residual) const {
    if (of_membrane_) return of_membrane_->apply(residual);
    Vector result(size());
    result.tail(n_tension()) = inverse_.col(3).cwiseProduct(residual.tail(n_tension()));
    if (normal_.empty()) return result;
    const auto held = inverse_.middleRows(first_held_, n_normal());
    const auto normal = residual.head(n_normal());
    result.head(n_normal()) = held.col(0).cwiseProduct(normal) +
                              held.col(1).cwiseProduct(residual.segment(n_normal() + first_held_, n_normal()));
    result.segment(n_normal() + first_held_, n_normal()) += held.col(2).cwiseProduct(normal);
    return result;
  }

 private:
  /// What the first coefficient of λ, or the dilation in its place, does to ∫∇_γ·u dA on a sphere.
  [[nodiscard]] double first_response() const { return mean_tension_ ? of_dilation_[0] : mean_response_; }
  [[nodiscard]] Vector uniform(double value) const {
    Vector result = Vector::Zero(n_coefficients(membrane_.fine.order()));
    result[0] = value * std::sqrt(4.0 * std::numbers::pi);
    return result;
  }
  /// λ of the coefficients; where its mean is known, with this one.
  [[nodiscard]] Vector tension_of(const Matrix& fields, double mean) const {
    Vector tension = fields.col(0);
    if (!mean_tension_) return tension;
    tension[0] = 0.0;
    const Surface& s = membrane_.surface;
    const double mean_of_others = s.quadrature.dot(membrane_.fine.synthesize(tension).col(0)) / surface_area(s);
    return tension + uniform(mean - mean_of_others);
  }
  [[nodiscard]] Index n_tension() const { return std::ssize(tension_); }
  /// Degrees of c and u·n are those of the parameter sphere, so on points that have flowed degrees from 2 on have a
  /// part of degree 1 in space. Without the mean they neither hold a translation nor exert a net force.
  [[nodiscard]] Matrix without_mean(const Matrix& values) const {
    return values.rowwise() - surface_mean(membrane_.surface, values).transpose();
  }

  const FlowMembrane& one_;
  const Membrane& membrane_;
  bool is_sphere_;
  double mean_response_;
  std::optional<double> mean_tension_;                ///< with undulations
  Vector of_dilation_;                                ///< −J/(μR), entries of λ
  std::vector<Index> normal_, tension_;               ///< coefficients; those of c are also in a row among those of λ
  Index first_held_ = 0;                              ///< from there on
  Eigen::Matrix<double, Eigen::Dynamic, 4> inverse_;  ///< of a sphere, row by row for each coefficient of λ
  std::optional<TensionInverse> of_membrane_;
};

/// The unknowns of all membranes one behind the other.
class Layout {
 public:
  explicit Layout(const std::vector<OneTension>& all) {
    for (const OneTension& one : all) firsts_.push_back(firsts_.back() + one.size());
  }

  [[nodiscard]] Index size() const { return firsts_.back(); }
  [[nodiscard]] Index first(std::size_t a) const { return firsts_[a]; }
  [[nodiscard]] Index count(std::size_t a) const { return firsts_[a + 1] - firsts_[a]; }

  [[nodiscard]] Vector stack(const std::vector<Vector>& parts) const {
    Vector result(size());
    for (std::size_t a = 0; a < parts.size(); ++a) result.segment(first(a), count(a)) = parts[a];
    return result;
  }
  [[nodiscard]] std::vector<Vector> parts(const Vector& stacked) const {
    std::vector<Vector> result;
    for (std::size_t a = 0; a + 1 < firsts_.size(); ++a) result.emplace_back(stacked.segment(first(a), count(a)));
    return result;
  }

  /// What is known of the rows of each membrane, as rows of all. Nothing where one has something else.
  [[nodiscard]] RecycledSubspace joined(const std::vector<RecycledSubspace>& of_each, const Vector& scales) const {
    const Index columns = of_each.front().count();
    RecycledSubspace result{Matrix(size(), columns), Matrix(size(), columns)};
    for (std::size_t a = 0; a < of_each.size(); ++a) {
      if (of_each[a].count() != columns || of_each[a].arguments.rows() != count(a)) return {};
      result.arguments.middleRows(first(a), count(a)) = of_each[a].arguments;
      result.responses.middleRows(first(a), count(a)) = of_each[a].responses;
    }
    result.arguments = scales.cwiseInverse().asDiagonal() * result.arguments;
    return result;
  }
  /// The other way.
  [[nodiscard]] std::vector<RecycledSubspace> of_each(const RecycledSubspace& all, const Vector& scales) const {
    const Matrix arguments = scales.asDiagonal() * all.arguments;
    std::vector<RecycledSubspace> result;
    for (std::size_t a = 0; a + 1 < firsts_.size(); ++a) {
      result.push_back({arguments.middleRows(first(a), count(a)), all.responses.middleRows(first(a), count(a))});
    }
    return result;
  }

 private:
  std::vector<Index> firsts_{0};
};

/// c and λ over their scales, which are alike for membranes of any size.
Vector scales_of(const std::vector<OneTension>& all, const Layout& layout) {
  Vector result = Vector::Ones(layout.size());
  for (std::size_t a = 0; a < all.size(); ++a) {
    result.segment(layout.first(a), layout.count(a))
        .tail(layout.count(a) - all[a].n_normal())
        .setConstant(all[a].membrane().radius);
  }
  return result;
}

/// The uniform parts of the tensions left out.
Vector without_means(const std::vector<OneTension>& all, const Layout& layout, Vector stacked) {
  for (std::size_t a = 0; a < all.size(); ++a) {
    if (layout.count(a) > 0) stacked[layout.first(a) + all[a].n_normal()] = 0.0;
  }
  return stacked;
}

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
/// @param whole  see OneTension::force
void add_forces(const std::vector<OneTension>& all, const std::vector<std::size_t>& own,
                const std::vector<Vector>& unknowns, bool whole, std::vector<Matrix>& weighted) {
  for_each_member(own, [&](std::size_t a) {
    const Matrix force = all[a].force(unknowns[a], whole);
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
  for (std::size_t a = 0; a < membranes.size(); ++a) all.emplace_back(membranes[a], is_sphere[a], flow.interacts());
  const std::vector<std::size_t> own = flow.shares().own(all.size());
  const auto gather = [&](std::vector<Vector>& unknowns) {
    flow.shares().gather(unknowns, [&](const Vector& of_original, std::size_t a) {
      return all[a].unknowns(flow.exchange().image(a).scalar(all[a].fields(of_original)));
    });
  };
  const bool many = are_many(static_cast<Index>(all.size()));
  if (many) find_inverses(all, own);
  const Layout layout(all);
  const Vector scales = scales_of(all, layout);
  const OwnVelocities of_own(all, own);
  const LinearMap map = [&](const Vector& v) {
    const std::vector<Vector> unknowns = layout.parts(v.cwiseProduct(scales));
    std::vector<Matrix> of_tensions(all.size());
    add_forces(all, own, unknowns, false, of_tensions);
    const std::vector<Matrix> velocities = flow.velocities(of_tensions);
    std::vector<Vector> result(all.size());
    for_each_member(own, [&](std::size_t a) { result[a] = all[a].response(velocities[a], unknowns[a]); });
    gather(result);
    // The velocities go along: those of the solution are then known without another application.
    Vector response(layout.size() + of_own.size());
    response << layout.stack(result), of_own.stack(velocities);
    return response;
  };
  const LinearMap preconditioner = [&](const Vector& residual) -> Vector {
    std::vector<Vector> parts = layout.parts(residual);
    // Those of spheres, which few membranes have, every rank has for all.
    if (many) {
      for_each_member(own, [&](std::size_t a) { parts[a] = all[a].approximate_inverse(parts[a]); });
      gather(parts);
    } else {
      for (std::size_t a = 0; a < all.size(); ++a) parts[a] = all[a].approximate_inverse(parts[a]);
    }
    return layout.stack(parts).cwiseQuotient(scales);
  };
  std::vector<Vector> guess;
  for (std::size_t a = 0; a < all.size(); ++a) guess.push_back(all[a].guess(start[a]));
  add_forces(all, own, guess, true, weighted);
  const std::vector<Matrix> before = flow.velocities(weighted, background);
  std::vector<Vector> left(all.size());
  for (const std::size_t a : own) left[a] = all[a].constraints(-before[a]);
  gather(left);
  const bool recycles = !many && std::ranges::count(is_sphere, true) == 0;
  const RecycledSubspace former = recycles ? layout.joined(known, scales) : RecycledSubspace{};
  RecycledGcr solver(map, preconditioner, layout.size(), of_own.size(), former);
  const Vector first = layout.stack(guess).cwiseQuotient(scales), rhs = layout.stack(left);
  RecycledGcr::Solution solution;
  int iterations = 0;
  // A start that was much larger than the solution says nothing of the tensions: then they do themselves.
  for (double size = without_means(all, layout, first).norm();;) {
    solution = solver.solve(rhs, {}, {tolerance, thresholds::most_flow_iterations}, size);
    iterations += solution.report.iterations;
    const double found = without_means(all, layout, first + solution.x).norm();
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
  const std::vector<Vector> unknowns = layout.parts((first + solution.x).cwiseProduct(scales));
  result.velocities = of_own.velocities(of_own.stack(before) + solution.further);
  for (std::size_t a = 0; a < all.size(); ++a) {
    result.tension.push_back(all[a].tension(unknowns[a]));
    result.force.push_back(flow.shares().owns(a) ? all[a].force(unknowns[a], true) : Matrix());
  }
  return result;
}

}  // namespace vehd

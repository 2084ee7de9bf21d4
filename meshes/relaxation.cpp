#include "meshes/relaxation.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace vehd::meshes {
namespace {

using Nodes = Eigen::Matrix3Xd;

/// Factorised stiffness of the inner nodes at one mesh, separate for each component.
class InnerStiffness {
 public:
  InnerStiffness(const Lattice& lattice, const Distortion& distortion) : lattice_(lattice), distortion_(distortion) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t node = 0; node < lattice.nodes().size(); ++node) {
      if (lattice.nodes()[node].boundary != Lattice::Boundary::none) continue;
      entries.emplace_back(static_cast<int>(entries.size()), static_cast<int>(node), 1.0);
    }
    inner_.resize(static_cast<Eigen::Index>(entries.size()), static_cast<Eigen::Index>(lattice.nodes().size()));
    inner_.setFromTriplets(entries.begin(), entries.end());
  }

  void factorise(const Nodes& x) {
    all_ = distortion_.stiffness(x);
    for (int component = 0; component < 3; ++component) {
      const Eigen::SparseMatrix<double> inner = inner_ * all_[component] * inner_.transpose();
      if (!analysed_) factor_[component].analyzePattern(inner);
      factor_[component].factorize(inner);
    }
    analysed_ = true;
  }

  /// Displacement of the inner nodes under a force on the nodes; boundary nodes are fixed.
  [[nodiscard]] Nodes displacement(const Nodes& force) const {
    Nodes result = Nodes::Zero(3, force.cols());
    for (int component = 0; component < 3; ++component) {
      const Eigen::VectorXd inner = inner_ * force.row(component).transpose();
      result.row(component) = (inner_.transpose() * factor_[component].solve(inner).eval()).transpose();
    }
    return result;
  }

  /// Extends a displacement of the boundary nodes, zero at all others, to the inner nodes.
  [[nodiscard]] Nodes continued(const Nodes& boundary) const {
    Nodes force(3, boundary.cols());
    for (int component = 0; component < 3; ++component) {
      force.row(component) = (all_[component] * boundary.row(component).transpose()).transpose();
    }
    return boundary - displacement(force);
  }

  /// Gradient of E with respect to the inner nodes.
  [[nodiscard]] Nodes gradient(const Nodes& x) const {
    Nodes result = distortion_.gradient(x);
    for (std::size_t node = 0; node < lattice_.nodes().size(); ++node) {
      if (lattice_.nodes()[node].boundary != Lattice::Boundary::none)
        result.col(static_cast<Eigen::Index>(node)).setZero();
    }
    return result;
  }

 private:
  const Lattice& lattice_;
  const Distortion& distortion_;
  Eigen::SparseMatrix<double> inner_;  ///< picks the inner nodes
  std::array<Eigen::SparseMatrix<double>, 3> all_;
  std::array<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>, 3> factor_;
  bool analysed_ = false;
};

/// Stored steps and changes of the gradient of the limited-memory method.
class Memory {
 public:
  void add(const Nodes& step, const Nodes& change) {
    const double product = step.cwiseProduct(change).sum();
    if (!(product > 0.0)) return;
    pairs_.push_back({step, change, 1.0 / product});
    constexpr std::size_t kLongest = 12;
    if (pairs_.size() > kLongest) pairs_.pop_front();
  }

  /// Approximate inverse second derivative times a gradient: the two-loop recursion.
  [[nodiscard]] Nodes direction(Nodes gradient, const InnerStiffness& stiffness) const {
    std::vector<double> share(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      share[i] = pairs_[i].scale * pairs_[i].step.cwiseProduct(gradient).sum();
      gradient -= share[i] * pairs_[i].change;
    }
    Nodes result = stiffness.displacement(gradient);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const double other = pairs_[i].scale * pairs_[i].change.cwiseProduct(result).sum();
      result += (share[i] - other) * pairs_[i].step;
    }
    return result;
  }

 private:
  struct Pair {
    Nodes step, change;
    double scale;
  };
  std::deque<Pair> pairs_;
};

/// Lowers the energy until the predicted gain of a step is below `tolerance` times it; false if n_steps do not suffice.
bool lower_energy(const Distortion& distortion, const InnerStiffness& stiffness, Nodes& x, int n_steps,
                  double tolerance) {
  constexpr double kLeastStep = 1e-9;
  constexpr double kSufficient = 1e-4;  // Armijo's condition
  Memory memory;
  double energy = distortion.energy(x);
  Nodes gradient = stiffness.gradient(x);
  for (int k = 0; k < n_steps; ++k) {
    const Nodes direction = memory.direction(gradient, stiffness);
    const double slope = gradient.cwiseProduct(direction).sum();
    if (!(slope > tolerance * energy)) return true;
    double length = 1.0;
    Nodes next = x - direction;
    double lowered = distortion.energy(next);
    while (!(lowered <= energy - kSufficient * length * slope)) {
      length *= 0.5;
      if (length < kLeastStep) return true;
      next = x - length * direction;
      lowered = distortion.energy(next);
    }
    const Nodes next_gradient = stiffness.gradient(next);
    memory.add(next - x, next_gradient - gradient);
    x = next;
    gradient = next_gradient;
    energy = lowered;
  }
  return false;
}

/// Remaining displacement of the boundary; zero at inner nodes.
Nodes remaining_displacement(const Lattice& lattice, const Nodes& x, const Nodes& boundary) {
  Nodes result = Nodes::Zero(3, x.cols());
  for (std::size_t node = 0; node < lattice.nodes().size(); ++node) {
    const auto i = static_cast<Eigen::Index>(node);
    if (lattice.nodes()[node].boundary != Lattice::Boundary::none) result.col(i) = boundary.col(i) - x.col(i);
  }
  return result;
}

}  // namespace

Nodes relaxed_nodes(const Lattice& lattice, const Distortion& distortion, const Nodes& start,
                    const std::function<Nodes(double share)>& boundary_at) {
  constexpr double kFirstPart = 0.1, kLeastPart = 1e-3, kLonger = 1.5;
  constexpr double kLeastSqueeze = 0.2;  // smallest det F after an increment over that before it
  constexpr int kStepsOnTheWay = 8, kStepsAtTheEnd = 25, kRoundsAtTheEnd = 6;
  constexpr double kToleranceOnTheWay = 1e-4, kToleranceAtTheEnd = 1e-6;
  InnerStiffness stiffness(lattice, distortion);
  Nodes x = start;
  stiffness.factorise(x);
  double smallest = distortion.smallest_determinant(x);
  double part = kFirstPart;
  for (double share = 0.0; share < 1.0;) {
    const double next_share = std::min(1.0, share + part);
    const Nodes next = x + stiffness.continued(remaining_displacement(lattice, x, boundary_at(next_share)));
    if (!(distortion.smallest_determinant(next) >= kLeastSqueeze * smallest)) {
      part *= 0.5;
      if (part > kLeastPart) continue;
      throw MeshError(
          fmt::format("the blocks cannot follow the shape: their cells collapse at {:.0f} % of the way from a "
                      "sphere, {} the membrane",
                      100.0 * share, lattice.region() == Region::inside ? "inside" : "outside"));
    }
    x = next;
    share = next_share;
    stiffness.factorise(x);
    lower_energy(distortion, stiffness, x, kStepsOnTheWay, kToleranceOnTheWay);
    smallest = distortion.smallest_determinant(x);
    part *= kLonger;
  }
  for (int round = 0; round < kRoundsAtTheEnd; ++round) {
    stiffness.factorise(x);
    if (lower_energy(distortion, stiffness, x, kStepsAtTheEnd, kToleranceAtTheEnd)) break;
  }
  return x;
}

}  // namespace vehd::meshes

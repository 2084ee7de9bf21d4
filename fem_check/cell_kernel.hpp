#pragma once

#include <memory>
#include <vector>

#include "fem_check/lanes.hpp"

namespace vehd::fem_check {

/// Highest supported degree of elements.
constexpr int highest_degree = 10;

/// Evaluates nodal functions of one degree on the unit cell at Gauss points by sum factorisation, for several cells at
/// once. Nodes and points are numbered with the first direction fastest; nodes are Gauss–Lobatto points.
class CellKernel {
 public:
  /// Elements of degree k use k + 2 Gauss points per direction, k + 1 if they only precondition, and k + 3 for the
  /// pressure, one degree below its velocity: only these combinations are compiled.
  /// @throws std::invalid_argument for other combinations, and for degrees above highest_degree
  CellKernel(int degree, int n_points);

  [[nodiscard]] unsigned n_points() const { return n_points_; }  ///< of a cell

  /// Values at the points.
  void values(const Lanes* nodal, Lanes* at_points) const { functions_.values(*tables_, nodal, at_points); }
  /// Derivatives with respect to the unit coordinates, [3 x points]: one direction after the other.
  void gradients(const Lanes* nodal, Lanes* at_points) const { functions_.gradients(*tables_, nodal, at_points); }
  /// Σ φ_i(q) f(q) for every nodal function φ_i.
  /// @param at_points  f; overwritten
  void integrate_values(Lanes* at_points, Lanes* nodal) const {
    functions_.integrate_values(*tables_, at_points, nodal);
  }
  /// Σ ∂φ_i(q)·f(q), ∂ the derivatives with respect to the unit coordinates.
  /// @param at_points  f, in the layout of gradients(); overwritten
  void integrate_gradients(Lanes* at_points, Lanes* nodal) const {
    functions_.integrate_gradients(*tables_, at_points, nodal);
  }

  /// Map along one direction that is symmetric or antisymmetric about the middle of the edge: applied to the sums and
  /// the differences of values on both sides of the middle, which halves the number of products.
  struct Map {
    std::vector<double> of_sums, of_differences;
  };
  struct Tables {
    Map value, value_transposed;  ///< from nodes to points, and back
    Map slope, slope_transposed;  ///< from values at points to derivatives there, and back
  };
  struct Functions {
    void (*values)(const Tables&, const Lanes*, Lanes*);
    void (*gradients)(const Tables&, const Lanes*, Lanes*);
    void (*integrate_values)(const Tables&, Lanes*, Lanes*);
    void (*integrate_gradients)(const Tables&, Lanes*, Lanes*);
  };

 private:
  unsigned n_points_;
  Functions functions_;
  std::shared_ptr<const Tables> tables_;
};

}  // namespace vehd::fem_check

#pragma once

#include <memory>

#include "fem_check/flow.hpp"

namespace vehd::fem_check {

/// Stokes flow around a membrane that keeps its area elements, with the tension that sees to it. Immutable.
class InextensibleFlow {
 public:
  struct Data;
  explicit InextensibleFlow(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  /// Velocity and pressure, on γ and off it.
  [[nodiscard]] const FlowSolution& flow() const;
  /// λ at points of γ, force per length; without its mean over γ if the constant is not determined.
  [[nodiscard]] Vector tension(const SurfacePoints& points) const;
  /// f_λ as the trace function with ∫ f_λ·w dA = −∫ λ ∇_γ·w dA.
  [[nodiscard]] Vectors tension_force(const SurfacePoints& points) const;
  /// False on a sphere, where a constant tension is a pressure inside and nothing else.
  [[nodiscard]] bool constant_is_determined() const;
  /// For solvers that begin from it.
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// Operators added to FlowOperators for a membrane that keeps its area elements. Immutable.
class InextensibleOperators {
 public:
  struct Data;
  /// @throws std::invalid_argument as FlowOperators, and for several vesicles
  InextensibleOperators(const Discretisation& discretisation, FlowOperators flow);

  /// For the solver.
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// The flow of `problem` with ∇_γ·v = e on γ, e its dilation, 0 where the area elements are kept: the force of the
/// problem does not contain f_λ, which is found,
///
///   2μ∫ D(v):D(w) − ∫ p div w + ∫_γ λ ∇_γ·w dA = ∫_γ f·w dA,  ∫ q div v = 0,  ∫_γ χ (∇_γ·v − e) dA = 0,
///
/// with v of degree k, p and λ of degree k − 1. λ > 0 is tension.
/// @param start  what the linear solver begins from, on the same mesh with elements of any degree; null: zero
/// @throws std::invalid_argument, SolveError as solve_flow
/// Accuracy: spheres in linear flows at every viscosity ratio, and orders of convergence
/// (tests/fem_check/inextensible_flow_test.cpp)
/// Source: paper Eqs. (1e), (2); weak form and stability in docs/weak_forms.md
InextensibleFlow solve_inextensible_flow(const Discretisation& discretisation, const FlowProblem& problem,
                                         const InextensibleFlow* start = nullptr);
/// Solves with given operators.
/// @throws std::invalid_argument also for a problem with other viscosities
InextensibleFlow solve_inextensible_flow(const InextensibleOperators& operators, const FlowProblem& problem,
                                         const InextensibleFlow* start = nullptr);

}  // namespace vehd::fem_check

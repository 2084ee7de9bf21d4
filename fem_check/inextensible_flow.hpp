#pragma once

#include <memory>

#include "fem_check/flow.hpp"

namespace vehd::fem_check {

/// Stokes flow around a membrane whose area elements are constant, with the tension that enforces this. Immutable.
class InextensibleFlow {
 public:
  struct Data;
  explicit InextensibleFlow(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  /// Velocity and pressure.
  [[nodiscard]] const FlowSolution& flow() const;
  /// λ at points of γ, [points.size()], force per length; without its mean over γ if the constant is not determined.
  [[nodiscard]] Vector tension(const SurfacePoints& points) const;
  /// f_λ, [3 x points.size()], as the trace function with ∫ f_λ·w dA = −∫ λ ∇_γ·w dA.
  [[nodiscard]] Vectors tension_force(const SurfacePoints& points) const;
  /// False on a sphere, where a constant tension only changes the pressure inside.
  [[nodiscard]] bool constant_is_determined() const;
  /// Data for solvers that use it as initial guess.
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// Operators for an inextensible membrane, in addition to FlowOperators. Immutable.
class InextensibleOperators {
 public:
  struct Data;
  /// @throws std::invalid_argument as FlowOperators, and for several vesicles
  InextensibleOperators(const Discretisation& discretisation, FlowOperators flow);

  /// Data for the solver.
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// Flow of `problem` with ∇_γ·v = e on γ, e its dilation, 0 if the area elements are constant. The given force does not
/// contain f_λ, which is part of the solution,
///
///   2μ∫ D(v):D(w) − ∫ p div w + ∫_γ λ ∇_γ·w dA = ∫_γ f·w dA,  ∫ q div v = 0,  ∫_γ χ (∇_γ·v − e) dA = 0,
///
/// with v of degree k, p and λ of degree k − 1. λ > 0 is tension.
/// @param start  initial guess, on the same mesh with elements of any degree; null: zero
/// @throws std::invalid_argument, SolveError as solve_flow
/// Accuracy: spheres in linear flows at every viscosity ratio, and orders of convergence
/// (tests/fem_check/inextensible_flow_test.cpp)
/// Source: paper Eqs. (1e), (2); weak form and stability in docs/weak_forms.md
InextensibleFlow solve_inextensible_flow(const Discretisation& discretisation, const FlowProblem& problem,
                                         const InextensibleFlow* start = nullptr);
/// Solves with given operators.
/// @throws std::invalid_argument also if the problem has other viscosities or another wall condition
InextensibleFlow solve_inextensible_flow(const InextensibleOperators& operators, const FlowProblem& problem,
                                         const InextensibleFlow* start = nullptr);

}  // namespace vehd::fem_check

#pragma once

#include <memory>

#include "fem_check/flow.hpp"
#include "fem_check/saddle_point.hpp"

namespace vehd::fem_check {

/// Stokes flow on one discretisation at one pair of viscosities: set up once, for any force and background flow.
class StokesSystem {
 public:
  /// @throws std::invalid_argument for a degree below 2 or a viscosity that is not positive
  StokesSystem(const Discretisation& discretisation, const Viscosities& viscosity);
  StokesSystem(const StokesSystem&) = delete;
  StokesSystem& operator=(const StokesSystem&) = delete;

  [[nodiscard]] const Space& space() const { return *space_; }
  [[nodiscard]] const SaddlePoint& matrix() const { return *matrix_; }
  /// Of the velocity: both sheets of γ move together.
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }

  /// Right-hand side of a FlowProblem with these viscosities.
  /// @throws std::invalid_argument for a missing force or a gradient with a trace
  [[nodiscard]] Blocks right_side(const FlowProblem& problem) const;
  /// The flow of a solution.
  [[nodiscard]] FlowSolution solution(const FlowProblem& problem, const Blocks& x, const Cost& cost) const;

 private:
  std::shared_ptr<const Space> space_;
  Viscosities viscosity_;
  Constraints constraints_;
  std::shared_ptr<dealii::DoFHandler<3>> pressure_dofs_;
  std::unique_ptr<SaddlePoint> matrix_;
};

}  // namespace vehd::fem_check

#pragma once

#include <memory>
#include <optional>

#include "bie/stepping/discretisation.hpp"
#include "bie/stepping/resolution.hpp"
#include "bie/stepping/step_plan.hpp"
#include "bie/stepping/stepper.hpp"

namespace vehd {

/// Share of the tolerance that the degrees left out may make up.
constexpr double truncation_share = 0.3;
/// Degree below which a run with a tolerance does not go, unless it may not go that high.
constexpr int lowest_adaptive_order = 8;

/// What a run needs to know but for its start.
struct EvolutionSetup {
  Model model;
  NumericalSettings settings;  ///< the degree is the highest that a run with a tolerance may take
  Symmetry symmetry;
  StepControl control;
};

/// What became of one step.
struct EvolutionStep {
  double dt = 0.0;
  double change = 0.0;      ///< see StepResult
  double raw_area = 0.0;    ///< likewise
  int rejected = 0;         ///< attempts that were thrown away
  int iterations_flow = 0;  ///< with those of the evaluation at the end, before the jump if there is one
  int iterations_electric = 0;
  bool at_snapshot = false;
};

/// A membrane on its way through time. With a tolerance the degree follows the spectrum of the state: it rises, and the
/// step is taken again, where the degrees left out would matter, and falls where they have long ceased to. The singular
/// quadrature becomes finer where the layers are no longer exact enough. What no quadrature resolves, parts of the
/// membrane much closer to each other than the grid spacing, ends the way.
///
/// A lower degree or coarser quadrature that cannot be solved for is left aside. Where a higher degree is needed and
/// cannot be solved for, the step is taken again with half the size, and the way ends where that becomes too small.
class Evolution {
 public:
  /// From a shape and V_m at time 0. @throws ConvergenceError
  Evolution(EvolutionSetup setup, const Matrix& position, const StartPotential& potential, Instruments& instruments);
  /// From a state of such a run.
  Evolution(EvolutionSetup setup, State state, Instruments& instruments);
  ~Evolution();

  /// Solves everything at the start; before the first step. @throws ConvergenceError
  void evaluate_start();

  /// One accepted step towards the next of the given times.
  /// @throws ConvergenceError where no step is acceptable; the state is the last good one
  EvolutionStep step(const EventTimes& events);

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const Evaluation& evaluation() const { return evaluation_; }
  /// Where the forcing jumps at the time of the state and a step has led there: the evaluation just before the jump,
  /// without operators. The other one is that just after it.
  [[nodiscard]] const std::optional<Evaluation>& before_jump() const { return before_jump_; }
  [[nodiscard]] int order() const { return discretisation_->order(); }
  /// Estimated share of what the degree leaves out, see Resolution.
  [[nodiscard]] double truncation() const;

 private:
  [[nodiscard]] bool adapts() const { return setup_.control.tolerance > 0.0; }
  [[nodiscard]] bool resolves(const Resolution& resolution) const;
  void start_at(int order, const Matrix& position, const StartPotential& potential);
  void change_discretisation(int order, std::int64_t quadrature_level);
  void arrive(State state);
  Advance advance_within(const StepPlan& plan, double wanted, EvolutionStep& record);
  [[nodiscard]] int raised_order(const Resolution& resolution) const;
  bool raise_order_for(const State& reached);
  void lower_order_if_idle();
  void lower_quadrature_if_idle();
  void economise();

  EvolutionSetup setup_;
  Instruments& instruments_;
  std::unique_ptr<Discretisation> discretisation_;
  State state_;
  Evaluation evaluation_;
  std::optional<Evaluation> before_jump_;
};

}  // namespace vehd

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bie/stepping/evaluation/initial_state.hpp"
#include "bie/stepping/evaluation/rest.hpp"
#include "bie/stepping/evaluation/smallest_gap.hpp"
#include "bie/stepping/evaluation/wrinkling.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/time/step_control.hpp"

namespace vehd {

/// Lowest degree of a run with a tolerance, unless the highest degree of its settings is lower.
constexpr int lowest_adaptive_order = 8;

/// Inputs of a run except its start.
struct EvolutionSetup {
  Model model;
  NumericalSettings settings;  ///< the degree is the highest one of a run with a tolerance
  Symmetry symmetry;
  StepControl control;
  Frame frame{};                     ///< of the state; messages give places in the laboratory
  std::vector<std::string> names{};  ///< of several vesicles in messages; if empty, their numbers
  Ranks ranks{};                     ///< that compute together: all calls of an Evolution are collective
  /// How messages write a time.
  std::function<std::string(double)> time_text = [](double time) { return fmt::format("{:g}", time); };
};

/// Receives the former state and evaluation when another state replaces them.
using KeepFormer = std::function<void(State&&, Evaluation&&)>;

/// Time integration of vesicles, one accepted step at a time.
///
/// With a tolerance the degree of each vesicle follows the spectrum of its state. If the state at the end of a step has
/// significant coefficients beyond the degree, the degree rises and the step is repeated, at most once; a degree that
/// is too high falls. The truncation error of a compressed membrane is limited to the tolerance over the expected
/// growth of wrinkles. With a tolerance the degree also rises with the inverse root of the gap between two vesicles.
///
/// The singular quadrature is refined if the layers lose accuracy. No quadrature resolves parts of a membrane much
/// closer to each other than the grid spacing: the run then ends. It also ends if two vesicles come too near, see
/// require_gap. Vesicles that are images of others under the symmetry have the degree and the quadrature of their
/// originals.
///
/// A lower degree or coarser quadrature whose solves fail is not used. If the solves of a higher degree fail, the step
/// is repeated with half the size, and the run ends if the size becomes too small.
///
/// Accuracy: with a tolerance, extents, energy, ∫λ dA and V_m of a field-driven prolate within three times the
/// tolerance (tests/stepping/adaptive_evolution_test.cpp); with steps of fixed size that of deferred_correction
class Evolution {
 public:
  /// Starts from shapes and V_m at time 0.
  /// @throws ConvergenceError if a steady V_m is not found
  Evolution(EvolutionSetup setup, const std::vector<StartMembrane>& start, Instruments& instruments);
  /// Continues from a state of such a run.
  Evolution(EvolutionSetup setup, State state, Instruments& instruments);

  /// Solves all fields at the start; to be called before the first step.
  /// @throws ConvergenceError if a solve fails
  void evaluate_start();

  /// One accepted step towards the next of the given times; its state is state().
  /// @throws ConvergenceError if no step is acceptable; state() is then the last accepted one
  StepAttempt step(const EventTimes& events);

  /// Latest end of the next step towards these times.
  [[nodiscard]] double reach(const EventTimes& events) const;
  /// Multiplies the largest step size by this factor; only with a tolerance.
  void scale_largest_step(double times) {
    if (adapts()) setup_.control.largest *= times;
  }

  /// Sets the function that is called before state and evaluation change, so that callers that view them without a copy
  /// can keep them alive; it can be empty.
  void keep_former(KeepFormer keep) { keep_former_ = std::move(keep); }

  /// The last accepted state.
  [[nodiscard]] const State& state() const { return state_; }
  /// Fields and operators there.
  [[nodiscard]] const Evaluation& evaluation() const { return evaluation_; }
  /// Evaluation just before a jump of the forcing, without operators, if the last step has ended at the jump;
  /// evaluation() is then the one just after it.
  [[nodiscard]] const std::optional<Evaluation>& before_jump() const { return before_jump_; }
  /// A time within the last step at which a snapshot was due, in a run with a tolerance: the state comes from the
  /// polynomial of the step, and its evaluation has no operators. No step ends there.
  struct DenseOutput {
    State state;
    Evaluation evaluation;
    SmallestGap gap;
  };
  /// The snapshots within the last step.
  [[nodiscard]] const std::vector<DenseOutput>& dense_output() const { return dense_output_; }
  /// Degree of a vesicle at present.
  [[nodiscard]] int order(std::size_t vesicle) const { return discretisation_.vesicle(vesicle).order(); }
  /// Largest estimated truncation error of all vesicles, see Resolution.
  [[nodiscard]] double truncation() const { return truncation(state_); }
  /// truncation() of another state of this run.
  [[nodiscard]] double truncation(const State& state) const;
  /// Resolution of a vesicle in a state of this run; with a tolerance only of its visible part.
  [[nodiscard]] Resolution resolution(const State& state, std::size_t vesicle) const;
  /// Smallest gap between two vesicles, or between a vesicle and the wall.
  [[nodiscard]] const SmallestGap& gap() const { return gap_; }
  /// See largest_rate() of a state.
  [[nodiscard]] double largest_rate() const { return vehd::largest_rate(setup_.model, state_, evaluation_); }

 private:
  [[nodiscard]] bool adapts() const { return setup_.control.tolerance > 0.0; }
  [[nodiscard]] int lowest_order() const;
  [[nodiscard]] double truncation_target() const;
  [[nodiscard]] StepPlan plan_towards(const EventTimes& events, double dt_next) const;
  void expect_growth(double end);
  [[nodiscard]] bool resolves(const Resolution& resolution, std::size_t vesicle) const;
  [[nodiscard]] SmallestGap smallest_gap(const State& state) const;
  [[nodiscard]] int order_of_gap(const SmallestGap& gap, std::size_t vesicle) const;
  [[nodiscard]] int raised_order(const Resolution& resolution, std::size_t vesicle) const;
  [[nodiscard]] std::vector<int> starting_orders(const std::vector<StartMembrane>& start) const;
  bool raise_orders_for_fields();
  bool raise_orders_for_growth();
  bool restart_at(const std::vector<int>& orders, const std::function<bool(const Evaluation& former)>& is_needed);
  void start_at(const std::vector<int>& orders, const std::vector<StartMembrane>& start);
  void change_space(std::size_t vesicle, int order, std::int64_t quadrature_level);
  void arrive(State state);
  void replace(State state, Evaluation evaluation);
  [[nodiscard]] StepAttempt attempted(const StepPlan& plan, const SnapshotTimes& snapshots,
                                      const StepAttempt& former) const;
  /// Consequence of an attempt at a step.
  enum class Reaction { accept, repeat_smaller, repeat_in_higher_degree };
  Reaction react(StepAttempt& attempt, const StepPlan& plan, std::vector<bool>& raised);
  void raise_order(std::size_t vesicle, const Resolution& reached, int enough);
  [[nodiscard]] std::vector<DenseOutput> evaluate_dense_output(const std::vector<State>& states, StepAttempt& attempt);
  bool raise_orders_for(const StepAttempt& attempt, std::vector<bool>& raised);
  void coarsen_order(std::size_t vesicle);
  void coarsen_quadrature(std::size_t vesicle);
  using Coarsening = void (Evolution::*)(std::size_t vesicle);
  void try_to_coarsen(Coarsening coarsening, std::size_t vesicle);
  void coarsen();

  EvolutionSetup setup_;
  Instruments& instruments_;
  Discretisation discretisation_;
  State state_;
  SmallestGap gap_;
  Evaluation evaluation_;
  double growth_ = 1.0;               // of wrinkles, see growth_of_wrinkles, with a tolerance
  std::vector<StartMembrane> start_;  // empty once it is evaluated
  std::optional<Evaluation> before_jump_;
  std::vector<DenseOutput> dense_output_;
  KeepFormer keep_former_;
};

}  // namespace vehd

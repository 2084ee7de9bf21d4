#pragma once

#include <memory>
#include <string>

#include "bie/stepping/fields.hpp"
#include "bie/stepping/model.hpp"
#include "bie/stepping/state.hpp"
#include "bie/support/instruments.hpp"

namespace vehd {

class Discretisation;

/// A state with everything that its shape determines: surface, operators, electric solution, forces, velocity.
/// Immutable; independent of dt, so a rejected step is retried from it at no further assembly.
struct Evaluation {
  Fields fields;
  Diagnostics diagnostics;
  int iterations_flow = 0;       ///< GMRES iterations of the tension solve
  int iterations_electric = 0;   ///< GMRES iterations of Eq. (12)
  bool electric_asleep = false;  ///< see electric_sleeps
  /// The layers are less exact than NumericalSettings::quadrature_tolerance, and finer quadrature would help.
  bool quadrature_is_coarse = false;
  FlowMemory flow_memory;  ///< that of the state with what the tension solve has learned
  Vector potential_rate;   ///< dV_m/dt of material points, Eq. (4e), coefficients; empty without electricity
  struct Parts;
  std::shared_ptr<const Parts> parts;  ///< surface and operators, for the step alone
};

/// Solves everything at a frozen state.
/// @param previous  of the same run, if there is one: where the shape is frozen its operators serve again
/// @param limit     which value counts where a waveform jumps at the time of the state
/// @throws ConvergenceError naming the solve that failed
Evaluation evaluate(const Model& model, const Discretisation& discretisation, const State& state,
                    Instruments& instruments, const Evaluation* previous = nullptr, Limit limit = Limit::after);

struct StepResult {
  bool accepted = false;
  std::string reason;   ///< why a step was rejected; empty when accepted
  State state;          ///< the new state when accepted, otherwise unspecified
  double change = 0.0;  ///< made by the last correction, see CorrectedStep
  /// Relative area error that the step would have left without its constraint: a drift of the step's order.
  double raw_area = 0.0;
  int iterations_flow = 0;
  int iterations_electric = 0;
};

/// One step of size dt and of the order that the settings ask for: the semi-implicit one of Eqs. (27)-(31), or its
/// deferred correction. Never throws for a step that merely went wrong.
StepResult step(const Model& model, const Discretisation& discretisation, const State& state,
                const Evaluation& evaluation, double dt, Instruments& instruments);

/// What rules the size of steps.
struct StepControl {
  double largest = 0.0;    ///< step size
  double smallest = 0.0;   ///< below it no more attempts are made
  double tolerance = 0.0;  ///< of StepResult::change; 0: the largest steps, smaller ones only where they fail
};

/// Steps of size dt, halved ten times at most where they fail.
StepControl fixed_steps(double dt);

/// One accepted step of size at most dt_limit, or the reason why there is none.
struct Advance {
  bool accepted = false;
  std::string reason;     ///< of the last rejection
  State state;            ///< with dt_next set
  double dt = 0.0;        ///< step size that was accepted
  double change = 0.0;    ///< of the accepted step, see StepResult
  double raw_area = 0.0;  ///< likewise
  int rejected = 0;       ///< attempts that were thrown away
  int iterations_flow = 0;
  int iterations_electric = 0;
};

/// Tries min(state.dt_next, dt_limit); halves after every failure. With a tolerance, an attempt that changed by more is
/// repeated with the step that its order makes just good enough, and dt_next follows the same law; without one, dt_next
/// doubles back towards the largest after every success.
Advance advance(const Model& model, const Discretisation& discretisation, const State& state,
                const Evaluation& evaluation, const StepControl& control, double dt_limit, Instruments& instruments);

/// V_m at time 0; neither member counts without the electric model.
struct StartPotential {
  bool steady = false;  ///< that of the steady state
  Vector given{};       ///< coefficients of any degree, where it is not steady; empty: zero
};

/// State at time 0 on the given shape, with its own area, volume and area element as references: strain zero.
State initial_state(const Model& model, const Discretisation& discretisation, const Matrix& position,
                    const StartPotential& potential, double dt, Instruments& instruments);

}  // namespace vehd

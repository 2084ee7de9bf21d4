#pragma once

#include <memory>
#include <vector>

#include "bie/physics/interaction.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/model.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/instruments.hpp"

namespace vehd {

/// Data of one membrane for a step, besides its fields.
struct VesicleSolution {
  /// Surface and operators, these on the rank of the vesicle alone; null in an evaluation that no step starts from.
  std::shared_ptr<const Membrane> membrane;
  bool is_sphere = false;  ///< see uniform_tension_is_free
  Unknowns rate;           ///< dy/dt of material points, coefficients; a sphere moves as a rigid one
  /// Force of all explicit effects on the fluid, values on the upsampled grid, [n_points x 3]; empty without them and
  /// on other ranks.
  Matrix force_of_effects;
  RecycledSubspaces recycled;  ///< those of the state with what the tension solve adds
};

/// A state with everything that its shapes determine: surfaces, operators, electric solution, forces, velocities.
/// Immutable; independent of dt, so a rejected step is retried from it at no further assembly.
struct SolvedFields {
  Fields fields;
  std::vector<VesicleSolution> vesicles;
  /// Layers of the membranes on one another, empty where there is only one; null where no step starts.
  std::shared_ptr<const Interaction> interaction;
  int iterations_flow = 0;         ///< of the tension solves
  int iterations_electric = 0;     ///< of Eq. (12)
  bool electric_inactive = false;  ///< see electric_inactive()
};

/// Accuracy of the layers between membranes, from the settings for those of each.
PairSettings pair_settings(const NumericalSettings& settings);

/// Whose operators serve.
enum class Shapes { of_state, of_previous };

/// Solves everything at a frozen state; collective, see Discretisation::shares.
/// @param previous  of the same run, if any: its spheres stay spheres, and where shapes rest its operators serve again
/// @param limit     which value counts where a waveform jumps at the time of the state
/// @param shapes    whether they are known to be those of `previous`, so that its operators serve again
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: spectral; an inextensible sphere in linear flows has the exact velocity to 1e-12 and the exact tension to
/// 1e-11 (tests/stepping/evaluation/evaluation_test.cpp)
/// Source: paper Eqs. (2), (3), (5), (12), with ∇_γ·v = 0 for the tension
SolvedFields solve_fields(const Model& model, const Discretisation& discretisation, const State& state,
                          Instruments& instruments, const SolvedFields* previous = nullptr, Limit limit = Limit::after,
                          Shapes shapes = Shapes::of_state);

/// Solved fields with the quantities of a history and checks of the operators.
struct Evaluation : SolvedFields {
  Diagnostics diagnostics;
};

/// solve_fields and diagnose.
Evaluation evaluate(const Model& model, const Discretisation& discretisation, const State& state,
                    Instruments& instruments, const Evaluation* previous = nullptr, Limit limit = Limit::after);

/// An evaluation without its operators, which take most of its memory, for states from which no step starts.
Evaluation without_operators(Evaluation evaluation);

}  // namespace vehd

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
  /// Surface and operators, these only on the rank of the vesicle; null in an evaluation that no step starts from.
  std::shared_ptr<const Membrane> membrane;
  bool is_sphere = false;  ///< see uniform_tension_is_free
  Unknowns rate;           ///< dy/dt of material points, coefficients; of a sphere rigid_sphere_velocity
  /// Force of all explicit effects on the fluid, values on the upsampled grid, [n_points x 3]; empty without them and
  /// on other ranks.
  Matrix force_of_effects;
  RecycledSubspaces recycled;  ///< those of the state, updated by the tension solve
};

/// A state with everything that its shapes determine: surfaces, operators, electric solution, forces, velocities.
/// Immutable; independent of dt, so a rejected step is retried from it without further assembly.
struct SolvedFields {
  Fields fields;
  std::vector<VesicleSolution> vesicles;
  /// Layers between the membranes, empty for a single one; null in an evaluation from which no step starts.
  std::shared_ptr<const Interaction> interaction;
  int iterations_flow = 0;         ///< of the tension solves
  int iterations_electric = 0;     ///< of the electric solves
  bool electric_inactive = false;  ///< see electric_inactive()
};

/// Accuracy of the layers between membranes, from the settings for those of each.
PairSettings pair_settings(const NumericalSettings& settings);

/// Whether operators are assembled or reused.
enum class Shapes { of_state, of_previous };

/// Solves for all fields of a frozen state; collective, see Discretisation::partition.
/// @param previous  of the same run, or null: its spheres stay spheres, and its operators are reused for frozen shapes
/// @param limit     which value of a waveform applies if it jumps at the time of the state
/// @param shapes    whether they are known to be those of `previous`, so that its operators are reused
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

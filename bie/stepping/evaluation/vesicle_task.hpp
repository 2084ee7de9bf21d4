#pragma once

#include "bie/physics/electric.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// One vesicle of a state on its way to a solution.
struct VesicleTask {
  const Model& model;
  const VesicleModel& vesicle;
  const NumericalSettings& settings;
  const MembraneSpace& space;
  const VesicleState& state;
  const Membrane& membrane;
  VesicleFields& fields;
  VesicleSolution& solution;
};

/// dV_m/dt = −(σ_i ∂φ_i/∂n + I)/C_m with the current I of current_through, Eq. (4e), coefficients. No net current leaves a closed membrane, which the
/// quadrature sees only up to its error.
Vector charging_rate(const VesicleTask& task, const ElectricParameters& electric, const ElectricTraces& traces);

/// The current through the membrane with its pores and pump under this V_m, outwards, values on the upsampled grid.
Vector current_through(const VesicleTask& task, const ElectricParameters& electric, const Vector& potential);

/// With V_m known: what a membrane that porates conducts, which becomes one of the task's fields, and how fast that
/// changes.
void add_poration(const VesicleTask& task);

/// Adds the explicit effects, whose force is noted.
void add_effects(const VesicleTask& task, const EffectInput& input, Forcing& forcing);

/// Adds the explicit effects and the bending force, which becomes one of the task's fields.
void add_forces(const VesicleTask& task, const EffectInput& input, Forcing& forcing);

}  // namespace vehd

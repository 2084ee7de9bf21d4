#pragma once

#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/solve/constrained_motion.hpp"

namespace vehd {

/// Start of a step; all members must outlive the step.
struct StepStart {
  const Model& model;
  const Discretisation& discretisation;
  const State& state;
  const SolvedFields& solved;  ///< at the state, with the operators that the step freezes
};

/// The unknowns y = (x, V_m) at one node of a step: every membrane at its material points and, if the node ends the
/// step, also at new nodes.
struct NodeSolution {
  double time = 0.0;
  std::vector<Motion> vesicles;
};

/// Purpose of a node: within a step fields stay with the material; at its end they are carried to new nodes.
enum class NodeEnd { material, remapped };

/// State at a remapped node; step sizes and recycled subspaces are those of the start, and there is no past.
State state_at(const StepStart& start, const NodeSolution& node);
/// State at a node within the step, at its material points.
State material_state(const StepStart& start, const NodeSolution& node);

/// Integrals of a tension over its membrane; 0 without tension, and on a sphere, where its mean is undetermined.
struct TensionIntegrals {
  double sum = 0.0;        ///< ∫λ dA
  double magnitude = 0.0;  ///< ∫|λ| dA
};

/// F = dy/dt at one node, with the instantaneous unknowns there that a history records.
struct Rate {
  struct Instantaneous {
    Matrix charge;               ///< q or its amplitude, [n_coefficients x 1 or 2]; empty without electricity
    Matrix potential_amplitude;  ///< of V_m in an averaged field; empty without
    TensionIntegrals tension;
  };
  std::vector<Unknowns> unknowns;  ///< of each vesicle, at material points; empty if unchanged
  std::vector<Instantaneous> instantaneous;
};

/// The rate from the fields solved at a node.
Rate rate_of(const SolvedFields& solved);

/// Difference of the instantaneous unknowns in two rates at one node, the largest of all vesicles.
struct InstantaneousDifference {
  double tension = 0.0;  ///< of ∫λ dA, over ∫|λ| dA
  double charge = 0.0;   ///< of q in the maximum norm, over its size, and of V_m in an averaged field

  [[nodiscard]] double largest() const { return std::max(tension, charge); }
};

/// The scales of tensions and charges are at least those of the bending modulus and of the field, see tension_scale and
/// charge_scale.
/// @param grids  a solution with membranes of the degrees of b; those of a can be lower
InstantaneousDifference instantaneous_difference(const Model& model, const SolvedFields& grids, const Rate& a,
                                                 const Rate& b);

/// Largest difference of two solutions of one node, of x over the radius and of V_m over its size.
double difference(const StepStart& start, const NodeSolution& a, const NodeSolution& b);

/// Visible difference of two solutions at one node, the largest of all vesicles: sliding does not count.
struct VisibleDifference {
  double shape = 0.0;      ///< of x along the normal, over the radius
  double potential = 0.0;  ///< of V_m at material points, over its size, and of the state of poration
};

VisibleDifference visible_difference(const StepStart& start, const NodeSolution& a, const NodeSolution& b);

}  // namespace vehd

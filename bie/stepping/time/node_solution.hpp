#pragma once

#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/solve/constrained_motion.hpp"

namespace vehd {

/// Where a step starts; all of it must outlive the step.
struct StepStart {
  const Model& model;
  const Discretisation& discretisation;
  const State& state;
  const SolvedFields& solved;  ///< at the state, with the operators that the step freezes
};

/// The unknowns y = (x, V_m) at one node of a step: every membrane at its material points, and where the node ends the
/// step also at new nodes.
struct NodeSolution {
  double time = 0.0;
  std::vector<Motion> vesicles;
};

/// Purpose of a node: within a step fields stay with the material; at its end they are carried to new nodes.
enum class NodeEnd { material, remapped };

/// The state at a node that is remapped, as far as the node tells: no step goes on from it.
State state_at(const StepStart& start, const NodeSolution& node);
/// Of a node within the step, at its material points.
State material_state(const StepStart& start, const NodeSolution& node);

/// A tension over the membrane that has it; both 0 where there is none, or a sphere leaves its mean open.
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
  std::vector<Unknowns> unknowns;  ///< of each vesicle, of material points; what does not change is empty
  std::vector<Instantaneous> instantaneous;
};

/// The rate from the fields solved at a node.
Rate rate_of(const SolvedFields& solved);

/// How two rates of one node differ in what is solved for at once, the largest of all vesicles.
struct InstantaneousDifference {
  double tension = 0.0;  ///< of ∫λ dA, over ∫|λ| dA
  double charge = 0.0;   ///< of q in the maximum norm, over its size, and of V_m where it is solved for at once

  [[nodiscard]] double largest() const { return std::max(tension, charge); }
};

/// Tensions and charges that are small against those of the bending modulus and of the field count as if they were
/// larger.
/// @param grids  a solution with membranes of the degrees of b; a may have lower ones
InstantaneousDifference instantaneous_difference(const Model& model, const SolvedFields& grids, const Rate& a,
                                                 const Rate& b);

/// Largest difference of two solutions of one node, of x over the radius and of V_m over its size.
double difference(const StepStart& start, const NodeSolution& a, const NodeSolution& b);

/// How two solutions of one node differ in what can be seen, the largest of all vesicles.
struct VisibleDifference {
  double shape = 0.0;      ///< of x along the normal, over the radius
  double potential = 0.0;  ///< of V_m at material points, over its size, and of the state of poration
};

VisibleDifference visible_difference(const StepStart& start, const NodeSolution& a, const NodeSolution& b);

}  // namespace vehd

#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/solve/constrained_motion.hpp"
#include "bie/stepping/solve/flow_system.hpp"
#include "bie/stepping/solve/rigid_sphere.hpp"

namespace vehd {

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

/// The unknowns y = (x, V_m) at one node of a step: every membrane at its material points, and where the node ends the
/// step also at new nodes.
struct NodeSolution {
  double time = 0.0;
  std::vector<Motion> vesicles;
};

/// How two solutions of one node differ in what can be seen, the largest of all vesicles.
struct VisibleDifference {
  double shape = 0.0;      ///< of x along the normal, over the radius
  double potential = 0.0;  ///< of V_m at material points, over its size, and of the state of poration
};

/// Purpose of a node: within a step fields stay with the material; at its end they are carried to new nodes.
enum class NodeEnd { material, remapped };

/// A step of the paper's semi-implicit scheme from the start of a step.
struct FirstOrderStep {
  double dt;
  NodeEnd end;
};

/// A correction of a node: y + (1 − dt L)⁻¹ r.
struct ImplicitSolve {
  const NodeSolution* y;
  std::vector<Unknowns> r;  ///< of each vesicle
  double dt;
  NodeEnd end;
};

/// The physics as a time scheme sees it during one step, with the operators at its start frozen. Four operations make
/// every scheme:
///
/// - rate: F(y), everything solved anew at y;
/// - implicit solve: (1 − dt L)⁻¹ with the stiff part L of F at the start, bending and tension by (27) and (28), the
///   charging of the membranes by (30), of those that porate together with what makes them conduct, which is not
///   linear;
/// - projection: each solve is repeated for what it leaves until area elements, areas and volumes hold;
/// - remap: the end of the step on nodes that keep the grid good.
///
/// Beside them a step may begin with the extrapolation of the one before, for which nothing is solved.
///
/// L contains each membrane's bending and tension on itself, and the charging of all on all: the hydrodynamic
/// interaction of membranes is smooth and enters through F.
///
/// Solving and projecting are one iteration, since errors of area and volume that a remap causes are projected out as
/// well: see constrained_motion. A solve that fails throws ConvergenceError and ends the attempt; its iterations count.
///
/// Nodes are independent within each operation, so that several nodes are evaluated on threads; results are
/// bit-identical for any number of threads.
///
/// Source: paper Eqs. (27)–(31)
class StepOperations {
 public:
  /// @param start  and what was solved there, like all else, must outlive the step
  StepOperations(const Model& model, const Discretisation& discretisation, const State& start,
                 const SolvedFields& at_start, Instruments& instruments);

  /// The state that the step starts from.
  [[nodiscard]] const State& start() const { return start_; }

  /// F at the start.
  [[nodiscard]] Rate rate() const;
  /// F at nodes, one Rate each, with the forcing just before a discontinuity there.
  std::vector<Rate> rates(std::span<const NodeSolution> nodes);
  Rate rate(const NodeSolution& node) { return std::move(rates({&node, 1}).front()); }

  /// The paper's semi-implicit step from the start, Eqs. (27)–(31): y_0 + dt (1 − dt L)⁻¹ F(y_0), with the field at its
  /// end.
  /// @param steps  of different sizes
  /// Accuracy: first order in dt (tests/stepping/time/time_order_test.cpp)
  std::vector<NodeSolution> first_order_steps(const std::vector<FirstOrderStep>& steps);
  NodeSolution first_order_step(const FirstOrderStep& step) { return std::move(first_order_steps({step}).front()); }
  /// The polynomial through the nodes of the last step and the start, at a time after it. Nothing is solved for, and no
  /// constraint holds but for what its error leaves. Only where `can_extrapolate`.
  /// Accuracy: of order one more than there are times in the past (tests/stepping/time/past_test.cpp)
  [[nodiscard]] NodeSolution extrapolated(double time) const;
  /// Whether a step of this size is short enough to extrapolate: at most longest_extrapolation times the last one.
  [[nodiscard]] bool can_extrapolate(double dt) const;
  /// Makes the start and the nodes before the last the past of the state at the last one; collective. A rigid sphere
  /// turns on the spot, which no polynomial follows as exactly as its own motion: with one there is no past.
  /// @param nodes  the last one remapped
  void store_past(const std::vector<NodeSolution>& nodes, State& state) const;

  /// Corrections of several nodes, see ImplicitSolve.
  /// @param solves  of different sizes
  std::vector<NodeSolution> implicit_solves(const std::vector<ImplicitSolve>& solves);
  NodeSolution implicit_solve(const ImplicitSolve& solve) { return std::move(implicit_solves({solve}).front()); }

  /// The state at the end of the step, from a node that is remapped; collective.
  [[nodiscard]] State end_state(const NodeSolution& node) const;
  /// A state within the step, from a node that is remapped; no step starts from it.
  [[nodiscard]] State passed_state(const NodeSolution& node) const;
  /// Largest difference of two solutions of one node, of x over the radius and of V_m over its size.
  [[nodiscard]] double difference(const NodeSolution& a, const NodeSolution& b) const;
  [[nodiscard]] VisibleDifference visible_difference(const NodeSolution& a, const NodeSolution& b) const;
  /// The free function of this name for the model of the step.
  [[nodiscard]] InstantaneousDifference instantaneous_difference(const Rate& a, const Rate& b) const {
    return vehd::instantaneous_difference(model_, at_start_, a, b);
  }

  /// Evaluations of new shapes so far.
  [[nodiscard]] int evaluations() const { return evaluations_; }
  /// Iterations so far of the flow solves.
  [[nodiscard]] int iterations_flow() const { return iterations_.flow; }
  /// Iterations so far of the charging and charge solves.
  [[nodiscard]] int iterations_electric() const { return iterations_.electric; }

 private:
  struct Iterations {
    int flow = 0, electric = 0;
  };
  /// Counters of the work for one node; other nodes may be worked on at the same time.
  struct NodeWork {
    Instruments& instruments;
    Iterations& iterations;
  };
  /// Calls body(i, work) for each of so many nodes, on threads where these are small.
  template <typename Body>
  void for_each_node(std::size_t count, const Body& body);
  [[nodiscard]] Rate rate(const NodeSolution& node, NodeWork& work) const;
  NodeSolution first_order_step(const FirstOrderStep& step, NodeWork& work);
  NodeSolution implicit_solve(const ImplicitSolve& solve, NodeWork& work);
  void prepare(double dt);
  [[nodiscard]] bool charges() const {
    return model_.electric.has_value() && !is_averaged(model_) && !at_start_.electric_inactive;
  }
  [[nodiscard]] State state_with(SurfaceFields Motion::*fields, const NodeSolution& node) const;
  [[nodiscard]] double normal_difference(std::size_t vesicle, const SurfaceFields& a, const SurfaceFields& b) const;
  [[nodiscard]] double potential_difference(std::size_t vesicle, const SurfaceFields& a, const SurfaceFields& b) const;
  /// The charges and states of poration of all membranes after an implicit step from these, see charge_membranes.
  /// @param residual  null for a step of backward Euler
  [[nodiscard]] std::vector<Unknowns> charged(const std::vector<Unknowns>& from, const std::vector<Unknowns>* residual,
                                              double time, double dt, NodeWork& work) const;
  [[nodiscard]] double poration_difference(std::size_t vesicle, const SurfaceFields& a, const SurfaceFields& b) const;
  void take(Unknowns charged, double time, std::size_t vesicle, SurfaceFields& fields) const;
  void forget_decayed(double time, std::size_t vesicle, Vector& potential) const;
  [[nodiscard]] const Partition& partition() const { return discretisation_.partition(); }
  [[nodiscard]] Arrival arrival(std::size_t vesicle, NodeEnd end, Instruments& instruments) const;
  using RigidMotion = std::function<SphereMotion(std::size_t vesicle, const Membrane& sphere)>;
  /// Solves and projects all vesicles, each on its rank; V_m of the start is that of the end. Collective.
  /// @param rigid  the motion of a sphere, which takes the place of the start's velocity there
  std::vector<Motion> motions(const std::vector<MotionStart>& starts, const RigidMotion& rigid, double dt, NodeEnd end,
                              NodeWork& work);
  /// The motion of one vesicle; others may be moved at the same time.
  Motion motion(std::size_t vesicle, const MotionStart& start, const RigidMotion& rigid, double dt, NodeEnd end,
                Instruments& instruments, int& iterations);

  const Model& model_;
  const Discretisation& discretisation_;
  const State& start_;
  const SolvedFields& at_start_;
  Instruments& instruments_;
  std::deque<FlowSystems> flow_;  // of each vesicle
  Iterations iterations_;
  int evaluations_ = 0;
};

}  // namespace vehd

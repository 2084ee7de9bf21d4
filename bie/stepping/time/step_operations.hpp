#pragma once

#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "bie/stepping/solve/rigid_sphere.hpp"
#include "bie/stepping/time/node_solution.hpp"

namespace vehd {

/// A step of the paper's semi-implicit scheme from the start of the current step.
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

/// The work of a step so far.
struct StepWork {
  int evaluations = 0;          ///< of new shapes
  int iterations_flow = 0;      ///< of the flow solves
  int iterations_electric = 0;  ///< of the charging and charge solves

  StepWork& operator+=(const StepWork& other) {
    evaluations += other.evaluations;
    iterations_flow += other.iterations_flow;
    iterations_electric += other.iterations_electric;
    return *this;
  }
};

/// The physics of one step, with the operators frozen at its start. Every scheme consists of four operations:
///
/// - rate: F(y), all fields solved at y;
/// - implicit solve: (1 − dt L)⁻¹ with the stiff part L of F at the start: bending and tension by (27) and (28),
///   charging by (30), for membranes that porate together with their conductance, which is nonlinear;
/// - projection: each solve is repeated for its remaining error until area elements, areas and volumes hold;
/// - remap: the fields at the end of the step are moved to nodes that keep the grid good.
///
/// L contains bending and tension of each membrane acting on itself, and the coupled charging of all: the hydrodynamic
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
  StepOperations(const StepStart& start, Instruments& instruments);

  [[nodiscard]] const StepStart& start() const { return start_; }

  /// F at nodes, one Rate each, with the forcing just before a discontinuity there.
  std::vector<Rate> rates(std::span<const NodeSolution> nodes);
  /// The paper's semi-implicit step from the start, Eqs. (27)–(31): y_0 + dt (1 − dt L)⁻¹ F(y_0), with the field at its
  /// end.
  /// @param steps  of different sizes
  /// Accuracy: first order in dt (tests/stepping/time/time_order_test.cpp)
  std::vector<NodeSolution> first_order_steps(const std::vector<FirstOrderStep>& steps);
  /// Corrections of several nodes, see ImplicitSolve.
  /// @param solves  of different sizes
  std::vector<NodeSolution> implicit_solves(const std::vector<ImplicitSolve>& solves);
  /// State at the end of the step, from a remapped node, with the recycled subspaces of the solves; collective.
  [[nodiscard]] State end_state(const NodeSolution& node) const;

  [[nodiscard]] const StepWork& work() const { return work_; }

 private:
  /// Counters of the work for one node; other nodes may be worked on at the same time.
  struct NodeWork {
    Instruments& instruments;
    StepWork& counted;
  };
  /// Calls body(i, work) for `count` nodes, side by side on threads if the operators are small.
  template <typename Body>
  void for_each_node(std::size_t count, const Body& body);
  [[nodiscard]] Rate rate(const NodeSolution& node, NodeWork& work) const;
  NodeSolution first_order_step(const FirstOrderStep& step, NodeWork& work);
  NodeSolution implicit_solve(const ImplicitSolve& solve, NodeWork& work);
  void prepare(double dt);
  [[nodiscard]] bool charges() const {
    return start_.model.electric.has_value() && !is_averaged(start_.model) && !start_.solved.electric_inactive;
  }
  /// The charges and states of poration of all membranes after an implicit step from these, see charge_membranes.
  /// @param residual  null for a step of backward Euler
  [[nodiscard]] std::vector<Unknowns> charged(const std::vector<Unknowns>& from, const std::vector<Unknowns>* residual,
                                              double time, double dt, NodeWork& work) const;
  void take(Unknowns charged, double time, std::size_t vesicle, SurfaceFields& fields) const;
  void clear_decayed(double time, std::size_t vesicle, Vector& potential) const;
  [[nodiscard]] const Partition& partition() const { return start_.discretisation.partition(); }
  [[nodiscard]] Arrival arrival(std::size_t vesicle, NodeEnd end, Instruments& instruments) const;
  using RigidMotion = std::function<SphereMotion(std::size_t vesicle, const Membrane& sphere)>;
  /// Solves and projects all vesicles, each on its rank; V_m of `starts` is already that of the end. Collective.
  /// @param rigid  motion of a sphere, which replaces the velocity of its start
  std::vector<Motion> motions(const std::vector<MotionStart>& starts, const RigidMotion& rigid, double dt, NodeEnd end,
                              NodeWork& work);
  /// The motion of one vesicle; others may be moved at the same time.
  Motion motion(std::size_t vesicle, const MotionStart& start, const RigidMotion& rigid, double dt, NodeEnd end,
                Instruments& instruments, int& iterations);

  StepStart start_;
  Instruments& instruments_;
  std::deque<FlowSystems> flow_;  // of each vesicle
  StepWork work_;
};

}  // namespace vehd

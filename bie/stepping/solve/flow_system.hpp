#pragma once

#include <list>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
#include "bie/stepping/solve/flow_equations.hpp"
#include "bie/stepping/state/recycled_subspaces.hpp"

namespace vehd {

/// The flow equations of one membrane or of several in one flow, solved together by one Krylov iteration with a
/// separate preconditioner for each membrane. A solve recycles the search directions of former ones, also of those on
/// other membranes and for other dt.
/// Accuracy: the tolerance of the solve; solutions satisfy the system to 1e-8, in at most 40 iterations at every ratio
/// of viscosities (tests/stepping/solve/flow_system_test.cpp)
class FlowSystem {
 public:
  /// @param flow      of the membranes of the equations, must outlive the system. With several ranks each needs the
  ///                  data of its own membranes, see Interaction, and has the unknowns of all
  /// @param recycled  part of RecycledSubspaces of each membrane, with common columns; dropped unless all are in these
  ///                  unknowns
  FlowSystem(std::vector<FlowEquations> equations, MembraneFlow& flow, std::vector<RecycledSubspace> recycled);
  FlowSystem(const FlowSystem&) = delete;
  FlowSystem& operator=(const FlowSystem&) = delete;

  struct Solution {
    SolveReport report;
    std::vector<FlowScalars> unknowns;
    /// On the membranes of this rank, coefficients [n_coefficients x 3].
    std::vector<Matrix> velocities;
    double size_of_rhs = 0.0;  ///< see RecycledGcr
  };
  /// Solves the equations of all membranes.
  /// @param right_sides  FlowEquations::rows of each membrane, [size()] of its equations
  /// @param tolerance    of the preconditioned residual, relative to the preconditioned right-hand side
  /// @param least_size   see RecycledGcr
  Solution solve(const std::vector<Vector>& right_sides, double tolerance, double least_size = 0.0);

  /// Response of the first membrane, whose area is free, to a uniform tension of 1, with the tension that makes ∇_γ·u
  /// uniform. Solved only once.
  const Solution& of_uniform_tension(double tolerance);

  [[nodiscard]] const std::vector<FlowEquations>& equations() const { return equations_; }
  /// Norm of unknowns over their scales, uniform tensions left out.
  [[nodiscard]] double size_of(const std::vector<FlowScalars>& unknowns) const;
  /// Sends the rows of each membrane, [size()] of its equations, to all ranks, and finds those of images from their
  /// originals. Collective.
  void gather(std::vector<Vector>& rows) const;
  /// Search directions of the solves so far, of each membrane, in the form of RecycledSubspaces.
  [[nodiscard]] std::vector<RecycledSubspace> found() const;
  /// The independent columns of the recycled subspaces.
  [[nodiscard]] std::vector<RecycledSubspace> kept() const;

 private:
  [[nodiscard]] Vector map(const Vector& v) const;
  [[nodiscard]] Vector preconditioned(const Vector& residual) const;
  [[nodiscard]] RecycledSubspace stacked_subspace() const;

  std::vector<FlowEquations> equations_;
  MembraneFlow& flow_;
  std::vector<std::size_t> own_;
  StackedEntries rows_;
  StackedEntries own_velocities_;
  std::vector<RecycledSubspace> recycled_;
  RecycledGcr solver_;
  std::optional<Solution> of_uniform_tension_;
};

/// The linearised systems of one step of one membrane, one for each implicit size; sweeps use the same sizes again.
class FlowSystems {
 public:
  /// @param membrane             must outlive the systems
  /// @param options              with the tension at the start of the step as held_tension
  /// @param explicit_relaxation  the part of that tension under which a sphere relaxes by this share in dt is not held
  /// @param recycled             of RecycledSubspaces
  FlowSystems(const FlowParameters& parameters, const Membrane& membrane, FlowOptions options,
              double explicit_relaxation, std::shared_ptr<const RecycledScalars> recycled);
  FlowSystems(const FlowSystems&) = delete;
  FlowSystems& operator=(const FlowSystems&) = delete;
  /// The system of this size, made at its first use; if there are too many, the oldest is dropped.
  [[nodiscard]] FlowSystem& of(double dt);
  /// The samples to recycle in the next step.
  [[nodiscard]] std::shared_ptr<const RecycledScalars> recycled() const;

 private:
  std::vector<FlowMembrane> alone_;
  Interaction none_;
  MembraneFlow flow_;
  FlowOptions options_;
  double explicit_tension_time_;  ///< over the dt of a system: the tension that is not held
  std::shared_ptr<const RecycledScalars> recycled_;
  std::list<std::pair<double, std::unique_ptr<FlowSystem>>> systems_;  // in the order of their first use
};

}  // namespace vehd

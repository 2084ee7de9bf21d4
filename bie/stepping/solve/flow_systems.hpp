#pragma once

#include <list>
#include <memory>
#include <utility>
#include <vector>

#include "bie/stepping/solve/flow_system.hpp"
#include "bie/stepping/state/recycled_subspaces.hpp"

namespace vehd {

/// The linearised systems of one step of one membrane, one for each implicit size; sweeps return to the same sizes.
class FlowSystems {
 public:
  /// @param membrane             must outlive the systems
  /// @param options              with the tension at the start of the step as the one to hold
  /// @param explicit_relaxation  of that tension, the part is not held under which a sphere relaxes by this much in dt
  /// @param recycled             of RecycledSubspaces
  FlowSystems(const FlowParameters& parameters, const Membrane& membrane, FlowOptions options,
              double explicit_relaxation, std::shared_ptr<const RecycledScalars> recycled);
  FlowSystems(const FlowSystems&) = delete;
  FlowSystems& operator=(const FlowSystems&) = delete;
  /// The system of this size, made where it is asked for first; the oldest of very many goes.
  [[nodiscard]] FlowSystem& of(double dt);
  /// For the next step.
  [[nodiscard]] std::shared_ptr<const RecycledScalars> recycled() const;

 private:
  std::vector<FlowMembrane> alone_;
  Interaction none_;
  MembraneFlow flow_;
  FlowOptions options_;
  double explicit_tension_time_;  ///< times the dt of a system: the tension that is not held
  std::shared_ptr<const RecycledScalars> recycled_;
  std::list<std::pair<double, std::unique_ptr<FlowSystem>>> systems_;  // in the order in which they were asked for
};

}  // namespace vehd

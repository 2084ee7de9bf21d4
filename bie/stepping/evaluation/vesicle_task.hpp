#pragma once

#include <vector>

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

}  // namespace vehd

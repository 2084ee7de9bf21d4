#pragma once

#include "bie/estimate/cost_table.hpp"
#include "bie/estimate/plan.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Adds cost. Without a tolerance: seconds per step and memory from a few steps of the scene itself; of a degree for
/// which there is no time they follow from lower ones, see CostModel. With a tolerance: steps, seconds and memory that
/// whole runs with looser tolerances lead to expect, see cost_table_of. No step is taken that the run would not take:
/// that the scene's own steps cannot be taken is a finding, that those of a looser run or of a lower degree cannot is
/// none.
/// @param budget  whose seconds hold whatever the scene, to the part of a step that is in hand when they are over
void predict_cost(const Scene& scene, RunPlan& plan, CostCache& cache, const CostBudget& budget = {});

}  // namespace vehd

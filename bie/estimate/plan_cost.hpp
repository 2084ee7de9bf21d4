#pragma once

#include "bie/estimate/cost_table.hpp"
#include "bie/estimate/plan.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Adds cost. Without a tolerance: seconds per step and memory from a short run of the scene, files included, in a
/// temporary folder; where steps cannot be taken that is the finding. Orders above 32 are timed at 32 and scaled with
/// the growth of assembly, p^5, and of operators, p^4. With a tolerance: steps, seconds and memory that whole runs with
/// looser tolerances lead to expect, see cost_table_of.
/// @param budget  of the looser runs
/// @throws OutputError
void predict_cost(const Scene& scene, RunPlan& plan, CostCache& cache, const CostBudget& budget = {});

}  // namespace vehd

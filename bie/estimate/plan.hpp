#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bie/estimate/cost_table.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

struct PlannedEffect {
  std::string name;
  std::string adds;       ///< the term of the model
  std::string if_absent;  ///< what a run would save without it
};

struct PlannedOperator {
  std::string name;  ///< as in kernel_evaluations of summary.json
  std::string why;
};

/// What a run of a scene will do and cost.
struct RunPlan {
  std::vector<PlannedEffect> effects;
  std::vector<std::string> absent;
  std::string symmetry;
  std::vector<PlannedOperator> operators;
  std::uint64_t kernel_evaluations = 0;  ///< of each operator at each new shape
  int shapes_per_step = 1;
  std::int64_t unknowns = 0;  ///< independent scalars that the solves of a step find
  std::int64_t n_steps = 0;   ///< if none is rejected; with a tolerance known after predict_cost
  double seconds_per_step = 0.0;
  std::int64_t memory_bytes = 0;
  std::string stops;  ///< why the steps of a trial could not be taken, and when; nothing is predicted then
};

/// Everything that follows from the scene alone; costs are left at zero.
RunPlan plan_of(const Scene& scene);

/// Adds cost. Without a tolerance: seconds per step and memory from a short run of the scene, files included, in a
/// temporary folder; where steps cannot be taken that is the finding. Orders above 32 are timed at 32 and scaled with
/// the growth of assembly, p^5, and of operators, p^4. With a tolerance: steps, seconds and memory that whole runs with
/// looser tolerances lead to expect, see menu_of.
/// @param budget  of the looser runs
/// @throws OutputError
void predict_cost(const Scene& scene, RunPlan& plan, CostCache& cache, const MenuBudget& budget = {});

}  // namespace vehd

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bie/scene/model_range.hpp"
#include "bie/scene/run_times.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// One effect of a plan, present or absent.
struct PlannedEffect {
  std::string name;
  std::string adds;       ///< the term of the model
  std::string if_absent;  ///< savings without it
};

/// One operator of a plan, with the reason.
struct PlannedOperator {
  std::string name;  ///< as in kernel_evaluations of summary.json
  std::string why;
  std::size_t n_vesicles = 1;  ///< that need it
};

/// Effects, operators and cost of a run.
struct RunPlan {
  std::vector<PlannedEffect> effects;
  std::vector<std::string> absent;
  std::vector<DimensionlessGroup> groups;  ///< without times
  std::vector<std::string> si_of_groups;   ///< SI values; empty for pure numbers and without a scale
  std::vector<RunTime> times;
  std::vector<ModelWarning> warnings;  ///< where the scene leaves the range of the model, by estimates for a sphere
  std::string symmetry;
  std::vector<PlannedOperator> operators;
  std::uint64_t kernel_evaluations = 0;               ///< per operator, vesicle and new shape
  std::vector<std::string> vesicles;                  ///< names; empty for a single vesicle
  std::map<std::string, std::uint64_t> pair_targets;  ///< of layers between membranes at the start, as in summary.json
  int shapes_per_step = 1;
  std::int64_t n_jumps = 0;   ///< of the forcing, up to the end; each needs one more evaluation of the shape
  std::int64_t unknowns = 0;  ///< independent scalars that the solves of a step find
  std::int64_t n_steps = 0;   ///< without rejections; with a tolerance set by predict_cost
  double seconds_per_step = 0.0;
  std::int64_t memory_bytes = 0;
  std::string stops;    ///< why the steps of the run cannot be taken, and when; nothing is predicted then
  std::string unknown;  ///< why no cost is predicted although nothing stops; empty otherwise
};

/// Everything that follows from the scene without a trial run; costs are left at zero.
RunPlan plan_of(const Scene& scene);

}  // namespace vehd

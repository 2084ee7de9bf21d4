#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/estimate/cost.hpp"
#include "bie/runs/resumption.hpp"
#include "bie/runs/summary.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/progress.hpp"
#include "bie/support/text_table.hpp"

namespace vehd {
namespace {

struct PlanOptions {
  SceneSource scene;
  bool costs = false;
  CommonOptions common;
};

nlohmann::json json_of(const RunPlan& plan) {
  nlohmann::json json;
  json["effects"] = nlohmann::json::array();
  for (const PlannedEffect& effect : plan.effects) {
    json["effects"].push_back({{"name", effect.name}, {"adds", effect.adds}, {"if_absent", effect.if_absent}});
  }
  json["absent"] = plan.absent;
  json["symmetry"] = plan.symmetry;
  json["operators"] = nlohmann::json::array();
  for (const PlannedOperator& op : plan.operators) {
    json["operators"].push_back({{"name", op.name}, {"why", op.why}});
    if (!plan.vesicles.empty()) json["operators"].back()["vesicles"] = op.n_vesicles;
  }
  if (!plan.vesicles.empty()) json["vesicles"] = plan.vesicles;
  if (!plan.vesicles.empty()) json["pair_targets"] = plan.pair_targets;
  json["kernel_evaluations_per_shape"] = plan.kernel_evaluations;
  json["shapes_per_step"] = plan.shapes_per_step;
  json["jumps"] = plan.n_jumps;
  json["groups"] = nlohmann::json::array();
  for (const DimensionlessGroup& group : plan.groups) {
    json["groups"].push_back({{"name", group.name},
                              {"symbol", group.symbol},
                              {"value", group.value},
                              {"si", plan.si_of_groups[json["groups"].size()]},
                              {"meaning", group.meaning}});
  }
  json["times"] = nlohmann::json::array();
  for (const RunTime& time : plan.times) {
    json["times"].push_back({{"name", time.name},
                             {"symbol", time.symbol},
                             {"value", time.value},
                             {"seconds", time.seconds ? nlohmann::json(*time.seconds) : nlohmann::json()},
                             {"meaning", time.meaning}});
  }
  json["warnings"] = json_of(plan.warnings);
  json["unknowns"] = plan.unknowns;
  json["steps"] = plan.n_steps;
  if (plan.stops.empty() && plan.unknown.empty()) {
    json["seconds_per_step"] = plan.seconds_per_step;
    json["memory_bytes"] = plan.memory_bytes;
  } else {
    json["seconds_per_step"] = json["memory_bytes"] = nullptr;
    json[plan.stops.empty() ? "unknown" : "stops"] = plan.stops.empty() ? plan.unknown : plan.stops;
  }
  return json;
}

void print_groups_and_times(const RunPlan& plan) {
  TextTable groups, times;
  for (const DimensionlessGroup& group : plan.groups) {
    const std::string& si = plan.si_of_groups[groups.size()];
    groups.push_back({std::string(group.symbol), si.empty() ? fmt::format("{:.4g}", group.value) : si,
                      std::string(group.name), std::string(group.meaning)});
  }
  for (const RunTime& time : plan.times) {
    times.push_back({time.symbol.empty() ? "–" : time.symbol, time.text(), time.name, time.meaning});
  }
  fmt::print("groups\n{}times\n{}", aligned(groups, "  "), aligned(times, "  "));
}

void print(const RunPlan& plan) {
  fmt::print("effects\n");
  for (const PlannedEffect& effect : plan.effects) {
    fmt::print("  {:<22} {}\n  {:<22} without it: {}\n", effect.name, effect.adds, "", effect.if_absent);
  }
  if (!plan.vesicles.empty()) {
    fmt::print("vesicles   {}: {}; groups are those of the first\n", plan.vesicles.size(),
               fmt::join(plan.vesicles, ", "));
  }
  print_groups_and_times(plan);
  if (!plan.warnings.empty()) fmt::print("outside the model, by estimates for a sphere\n");
  for (const ModelWarning& warning : plan.warnings) fmt::print("  {:<22} {}\n", warning.name, warning.text);
  fmt::print("absent     {}\n", fmt::join(plan.absent, ", "));
  fmt::print("symmetry   {}\n", plan.symmetry);
  const std::string jumps = plan.n_jumps == 0 ? "" : fmt::format(", one more at each jump ({})", plan.n_jumps);
  const char* of = plan.vesicles.empty() ? "" : ", vesicle";
  fmt::print("operators  ({} kernel evaluations per operator{} and shape; {} shapes a step{})\n",
             plan.kernel_evaluations, of, plan.shapes_per_step, jumps);
  for (const PlannedOperator& op : plan.operators) fmt::print("  {:<22} {}\n", op.name, op.why);
  if (const std::size_t n = plan.vesicles.size(); n > 1) {
    const auto targets = [&](const char* way) { return plan.pair_targets.at(way); };
    fmt::print(
        "pairs      {}: at the start {} targets by near quadrature, {} by direct sums, {} by multipole expansions\n",
        n * (n - 1), targets("near"), targets("far"), targets("expanded"));
  }
  fmt::print("unknowns   {} a step\n", plan.unknowns);
  if (!plan.stops.empty()) {
    fmt::print("cost       none: {}\n", plan.stops);
    return;
  }
  if (!plan.unknown.empty()) {
    fmt::print("cost       unknown: {}\n", plan.unknown);
    return;
  }
  fmt::print("cost       {} steps of {:.2g} s: {}, {:.0f} MB\n", plan.n_steps, plan.seconds_per_step,
             duration_text(static_cast<double>(plan.n_steps) * plan.seconds_per_step),
             static_cast<double>(plan.memory_bytes) / 1e6);
}

/// Reports a scene whose steps cannot be taken.
ExitCode steps_fail(const PlanOptions& options, const std::string& what) {
  fmt::print(stderr, "{}: cannot be stepped{}\n", options.scene.file.string(), what);
  return ExitCode::check_failed;
}

ExitCode print_costs(const PlanOptions& options, const Scene& scene) {
  const std::vector<CostRow> rows = cost_table_of(scene, {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7});
  nlohmann::json json = nlohmann::json::array();
  fmt::print("{:>9} {:>8} {:>7} {:>9} {:>7}\n", "tolerance", "degree", "steps", "time", "MB");
  for (const CostRow& row : rows) {
    if (!row.stops.empty() || !row.unknown.empty()) {
      const char* name = row.stops.empty() ? "unknown" : "stops";
      const std::string& reason = row.stops.empty() ? row.unknown : row.stops;
      fmt::print("{:>9.0e} {}: {}\n", row.tolerance, name, reason);
      json.push_back({{"tolerance", row.tolerance}, {name, reason}});
      continue;
    }
    fmt::print("{:>9.0e} {:>8} {:>7} {:>9} {:>7.0f}{}\n", row.tolerance, row.order, row.steps,
               duration_text(row.seconds), static_cast<double>(row.memory_bytes) / 1e6,
               row.measured ? "  measured" : "");
    json.push_back({{"tolerance", row.tolerance},
                    {"order", row.order},
                    {"steps", row.steps},
                    {"seconds", row.seconds},
                    {"memory_bytes", row.memory_bytes},
                    {"measured", row.measured}});
  }
  if (rows.back().order > 0) fmt::print("predictions hold within a factor of 3\n");
  write_json(options.common, json);
  const bool none = std::ranges::all_of(rows, [](const CostRow& row) { return !row.stops.empty(); });
  return none ? steps_fail(options, " at any of these tolerances: " + rows.back().stops) : ExitCode::done;
}

ExitCode plan(const PlanOptions& options) {
  const Scene scene = read_scene(options.scene);
  if (options.costs) return print_costs(options, scene);
  RunPlan result = plan_of(scene);
  predict_cost(scene, result);
  print(result);
  write_json(options.common, json_of(result));
  if (result.stops.empty()) return ExitCode::done;
  return steps_fail(options, fmt::format(": {}; {}", result.stops, advice_after_failure(scene.numerics)));
}

}  // namespace

void add_plan_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("plan", "Predict the effects, operators and cost of a run");
  const auto options = std::make_shared<PlanOptions>();
  add_scene_choice(*command, options->scene);
  command->add_flag("--menu", options->costs, "Only the table of costs at tolerances from 1e-2 to 1e-7");
  add_threads_option(*command);
  add_common_options(*command, options->common);
  command->footer(
      "Seconds and memory come from a few steps of the scene, with a tolerance from a trial run with the tolerance\n"
      "1e-2, and hold within a factor of 3. The command takes less than 10 s; \"unknown\": the time was too short.\n"
      "Exit code 4 if the run cannot take its first steps.");
  command->callback([options, &exit_code] { exit_code = plan(*options); });
}

}  // namespace vehd

#include "bie/bench/methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "bie/bench/example1.hpp"
#include "bie/comparison/check_input.hpp"
#include "bie/comparison/fem_program.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/support/memory.hpp"
#include "bie/support/temporary.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
namespace {

const MethodCurve bie{"bie", "BIE, degree p rises"};
const MethodCurve fem_degree{"fem_degree", "FEM, degree k rises"};
const MethodCurve fem_mesh{"fem_mesh", "FEM, mesh refined, k = 2"};

/// Cells per edge of a block where the degree rises.
constexpr int coarse_cells = 3;

/// Outer sphere over the radius of the shape; the second one shows what the first leaves out.
constexpr double near_radius = 8.0, far_radius = 16.0;
/// Highest degree of the comparison of both.
constexpr int highest_far_degree = 5;

struct LevelPlan {
  std::vector<int> orders;          ///< p
  std::vector<int> element_degree;  ///< k on the coarse mesh
  std::vector<int> cells_per_edge;  ///< at the lowest of these degrees
};

LevelPlan plan_of(bool quick) {
  if (quick) return {{8, 12}, {2, 3}, {3, 4}};
  return {{8, 12, 16, 20, 24, 32}, {2, 3, 4, 5, 6, 7}, {2, 3, 4, 6, 8, 12}};
}

MethodLevel bie_level(int order, int repeats) {
  MethodLevel level;
  level.curve = bie;
  level.degree = order;
  level.unknowns = std::int64_t{order + 1} * (order + 1);
  const int upsampling = NumericalSettings().upsampling;
  while (wants_repeat(level.seconds, repeats)) {
    const std::clock_t start = std::clock();
    const PointSourceErrors errors = solve_example1(order, upsampling).errors;
    level.seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    level.charge_l2 = errors.charge_l2;
    level.charge_max = errors.charge;
    level.force_l2 = errors.force_l2;
    level.force_max = errors.force;
  }
  level.peak_memory_bytes = peak_memory_bytes();
  return level;
}

/// Runs the levels of finite elements; each is a process of its own.
class FemLevels {
 public:
  FemLevels(const std::filesystem::path& directory, int shape_order) : input_(directory / "sources.h5") {
    write_sources_input(input_.path(), example1_position(shape_order), example1_electric(), example1_sources());
  }

  double outer_radius = 0.0;

  MethodLevel operator()(const MethodCurve& curve, int degree, int cells_per_edge, int repeats,
                         double radius = near_radius) {
    MethodLevel level;
    level.curve = curve;
    level.degree = degree;
    level.cells_per_edge = cells_per_edge;
    while (wants_repeat(level.seconds, repeats)) {
      const FemProgram::Result result =
          program_.run({"sources", input_.path().string(), "--degree", std::to_string(degree), "--cells",
                        std::to_string(cells_per_edge), "--radius", fmt::format("{}", radius)});
      if (result.code != ExitCode::done) throw std::runtime_error("the finite elements stopped, see above");
      const nlohmann::json& json = result.json;
      level.seconds.push_back(json["seconds"]);
      level.unknowns = json["dofs"];
      level.peak_memory_bytes = json["memory_bytes"];
      level.charge_l2 = json["fields"]["q"]["l2"];
      level.charge_max = json["fields"]["q"]["max"];
      level.force_l2 = json["fields"]["force"]["l2"];
      level.force_max = json["fields"]["force"]["max"];
      outer_radius = json["truncation_radius"];
    }
    return level;
  }

 private:
  FemProgram program_;
  TemporaryFile input_;
};

BenchTable empty_methods_table() {
  constexpr const char* kError = "{:.1e}";
  return {"rows",
          {{"method", ""},
           {"label", "method", "{}", false, 25},
           {"degree", "degree"},
           {"cells_per_edge", "cells"},
           {"unknowns", "unknowns"},
           {"seconds", "seconds", "{:.2g}", true},
           {"memory_bytes", ""},
           {"megabytes", "MB", "{:.0f}"},
           {"error_q", "error of q", kError},
           {"error_q_max", ""},
           {"error_force", "error of f_E", kError},
           {"error_force_max", ""}}};
}

std::vector<BenchCell> row_of(const MethodLevel& level) {
  BenchCell cells;
  if (level.cells_per_edge > 0) cells = std::int64_t{level.cells_per_edge};
  return {level.curve.name,
          level.curve.label,
          std::int64_t{level.degree},
          cells,
          level.unknowns,
          spread_of(level.seconds),
          level.peak_memory_bytes,
          static_cast<double>(level.peak_memory_bytes) / 1e6,
          level.charge_l2,
          level.charge_max,
          level.force_l2,
          level.force_max};
}

}  // namespace

BenchResult bench_methods(const MethodsTask& task, const std::filesystem::path& folder, BenchObserver& observer) {
  // Either method has one core, and its processor time counts: other programs on the machine then do not.
  const ThreadCount one_thread(1);
  const LevelPlan plan = plan_of(task.quick);
  const int shape_order = plan.orders.back();
  FemLevels fem(folder, shape_order);

  observer.note(
      fmt::format("Example 1 on shape (33), seconds of one core, up to {} repeats; errors: relative L2", task.repeats));
  BenchResult result{"methods", machine_record(), task.repeats, {}, {empty_methods_table()}};
  BenchTable& table = result.tables.front();
  BenchTasks tasks(static_cast<int>(plan.orders.size() + plan.element_degree.size() + plan.cells_per_edge.size() + 1),
                   observer);
  observer.heading(table);
  const auto keep = [&](const MethodLevel& level) { add_row(table, row_of(level), observer); };
  // Peak memory is that of the process so far: ascending orders make it that of the level.
  for (const int order : plan.orders) {
    tasks.next(fmt::format("boundary integrals, p = {}", order));
    keep(bie_level(order, task.repeats));
  }
  MethodLevel compared;
  for (const int degree : plan.element_degree) {
    tasks.next(fmt::format("finite elements, k = {}", degree));
    const MethodLevel level = fem(fem_degree, degree, coarse_cells, task.repeats);
    if (degree <= highest_far_degree) compared = level;
    keep(level);
  }
  for (const int cells : plan.cells_per_edge) {
    tasks.next(fmt::format("finite elements, {} cells per edge", cells));
    keep(fem(fem_mesh, plan.element_degree.front(), cells, task.repeats));
  }

  const double radius = fem.outer_radius;
  tasks.next("finite elements in a larger sphere");
  const MethodLevel far = fem(fem_degree, compared.degree, coarse_cells, 1, far_radius);
  const double change = std::abs(far.charge_l2 - compared.charge_l2);
  observer.note(fmt::format("outer sphere at R = {:.3g}; at {:.3g} the error of q at k = {} changes by {:.0e}", radius,
                            fem.outer_radius, far.degree, change));
  result.facts = {{"problem", "Example 1: shape (33), sigma_i = 2, sigma_e = 1, six point sources"},
                  {"seconds_are", "of one core, from the shape to q and f_E: tables, mesh, matrices, solve"},
                  {"shape_order", shape_order},
                  {"truncation_radius", radius},
                  {"truncation_radius_second", fem.outer_radius},
                  {"truncation_change_q", change}};
  return result;
}

}  // namespace vehd

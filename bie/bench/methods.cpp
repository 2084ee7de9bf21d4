#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <tuple>
#include <utility>

#include "bie/bench/benches.hpp"
#include "bie/bench/exact_problems.hpp"
#include "bie/bench/shape_flow_problem.hpp"
#include "bie/comparison/check_input.hpp"
#include "bie/comparison/fem_program.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
namespace {

/// A sequence of successively finer solutions by one method.
struct MethodCurve {
  std::string name;   ///< in the CSV and the JSON
  std::string label;  ///< in the table and the picture
};

/// One solution on one core.
struct MethodLevel {
  MethodCurve curve;
  int degree = 0;          ///< of the harmonics, or of the elements
  int cells_per_edge = 0;  ///< per edge of a block of the mesh; 0 without a mesh
  std::int64_t unknowns = 0;
  std::vector<double> seconds;  ///< processor time of each repeat, from the shape to the fields on γ
  std::optional<std::int64_t> peak_memory_bytes;
  MethodError first, second;  ///< of q and f_E, or of v and λ
};

const MethodCurve bie{"bie", "BIE, degree p rises"};
const MethodCurve fem_degree{"fem_degree", "FEM, degree k rises"};
const MethodCurve fem_mesh{"fem_mesh", "FEM, mesh refined, k = 2"};

/// Cells per edge of a block when the degree rises.
constexpr int coarse_cells = 3;

/// Radius of the outer sphere over that of the shape; the second one shows the error of cutting off at the first.
constexpr double near_radius = 8.0, far_radius = 16.0;
/// Highest degree of the comparison of these two.
constexpr int highest_far_degree = 5;

struct LevelPlan {
  std::vector<int> orders;                ///< p
  std::vector<int> element_degree;        ///< k on the coarse mesh
  std::vector<int> cells_per_edge;        ///< at the lowest of these degrees
  std::vector<int> element_degree_shape;  ///< k when all fields are found from the shape
  int reference_order;                    ///< degree of the reference for these
};

LevelPlan plan_of(bool quick) {
  if (quick) return {{8, 12}, {2, 3}, {3, 4}, {2, 3}, 16};
  return {{8, 12, 16, 20, 24, 32}, {2, 3, 4, 5, 6, 7}, {2, 3, 4, 6, 8, 12}, {3, 4, 5, 6, 7}, 48};
}

/// The problem that both methods solve.
struct MethodsProblem {
  const char* name;            ///< subcommand of the finite elements
  const char *first, *second;  ///< names of the fields in their result
};
constexpr MethodsProblem sources_problem{"sources", "q", "force"}, shape_problem{"shape-flow", "velocity", "tension"};

/// Processor time of this thread. Threads of earlier benches may still wait actively, which counts for the process.
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Timed boundary-integral solution at one degree.
/// @param n_scalars  unknown fields of its solves
/// @param solve      timed
/// @param errors_of  both errors of the result of `solve`; not timed
template <typename Solve, typename ErrorsOf>
MethodLevel integral_level(int order, int n_scalars, int repeats, const Solve& solve, const ErrorsOf& errors_of) {
  MethodLevel level;
  level.curve = bie;
  level.degree = order;
  level.unknowns = std::int64_t{n_scalars} * (order + 1) * (order + 1);
  while (wants_repeat(level.seconds, repeats)) {
    const double start = thread_seconds();
    const auto solved = solve();
    level.seconds.push_back(thread_seconds() - start);
    std::tie(level.first, level.second) = errors_of(solved);
  }
  level.peak_memory_bytes = memory_of([&] { static_cast<void>(solve()); });
  return level;
}

MethodLevel sources_level(int order, int repeats) {
  const int upsampling = NumericalSettings().upsampling;
  return integral_level(
      order, 1, repeats, [&] { return solve_example1(order, upsampling).errors; },
      [](const PointSourceErrors& errors) {
        return std::pair(MethodError{errors.charge_l2, errors.charge}, MethodError{errors.force_l2, errors.force});
      });
}

/// The unknowns of its solves are q and λ.
MethodLevel shape_level(const ShapeFlowProblem& problem, int order, int repeats) {
  return integral_level(
      order, 2, repeats, [&] { return problem.solve(order); },
      [&](const SolvedFields& solved) {
        const ShapeFlowErrors errors = problem.errors_of(solved);
        return std::pair(errors.velocity, errors.tension);
      });
}

/// Runs the levels of finite elements, each in a separate process.
class FemLevels {
 public:
  /// @param input  file of the problem, deleted at the end
  FemLevels(const MethodsProblem& problem, std::filesystem::path input) : problem_(problem), input_(std::move(input)) {}

  double outer_radius = 0.0;

  [[nodiscard]] const std::filesystem::path& input() const { return input_.path(); }

  MethodLevel operator()(const MethodCurve& curve, int degree, int cells_per_edge, int repeats,
                         double radius = near_radius) {
    MethodLevel level;
    level.curve = curve;
    level.degree = degree;
    level.cells_per_edge = cells_per_edge;
    while (wants_repeat(level.seconds, repeats)) {
      const FemProgram::Result result =
          program_.run({problem_.name, input_.path().string(), "--degree", std::to_string(degree), "--cells",
                        std::to_string(cells_per_edge), "--radius", fmt::format("{}", radius)});
      if (result.code != ExitCode::done) throw std::runtime_error("the finite elements stopped, see above");
      const nlohmann::json& json = result.json;
      const auto error = [&](const char* field) {
        return MethodError{json["fields"][field]["l2"], json["fields"][field]["max"]};
      };
      level.seconds.push_back(json["seconds"]);
      level.unknowns = json["dofs"];
      level.peak_memory_bytes = json["memory_bytes"].get<std::int64_t>();
      level.first = error(problem_.first);
      level.second = error(problem_.second);
      outer_radius = json["truncation_radius"];
    }
    return level;
  }

 private:
  MethodsProblem problem_;
  FemProgram program_;
  TemporaryFile input_;
};

/// @param headings  of both errors
BenchTable empty_methods_table(const std::string& name, const MethodsProblem& problem,
                               const std::array<const char*, 2>& headings) {
  constexpr const char* kError = "{:.1e}";
  const std::string first = std::string("error_") + problem.first, second = std::string("error_") + problem.second;
  return {name,
          {{"method", ""},
           {"label", "method", "{}", false, 25},
           {"degree", "degree"},
           {"cells_per_edge", "cells"},
           {"unknowns", "unknowns"},
           {"seconds", "seconds", "{:.2g}", true},
           {"memory_bytes", ""},
           {"megabytes", "MB", "{:.0f}"},
           {first, headings[0], kError},
           {first + "_max", ""},
           {second, headings[1], kError},
           {second + "_max", ""}}};
}

std::vector<BenchCell> row_of(const MethodLevel& level) {
  BenchCell cells, bytes, megabytes;
  if (level.cells_per_edge > 0) cells = std::int64_t{level.cells_per_edge};
  if (level.peak_memory_bytes) {
    bytes = *level.peak_memory_bytes;
    megabytes = static_cast<double>(*level.peak_memory_bytes) / 1e6;
  }
  return {level.curve.name,
          level.curve.label,
          std::int64_t{level.degree},
          cells,
          level.unknowns,
          spread_of(level.seconds),
          bytes,
          megabytes,
          level.first.l2,
          level.first.max,
          level.second.l2,
          level.second.max};
}

/// Cost of all fields that a step solves for, from the shape.
BenchTable from_shape_table(const LevelPlan& plan, int repeats, const std::filesystem::path& folder, BenchTasks& tasks,
                            BenchObserver& observer) {
  tasks.next(fmt::format("boundary integrals, p = {}, as the exact solution", plan.reference_order));
  const ShapeFlowProblem problem(plan.reference_order);
  FemLevels fem(shape_problem, folder / "shape_flow.h5");
  problem.write_input(fem.input());
  BenchTable table = empty_methods_table("from_shape", shape_problem, {"error of v", "error of λ"});
  observer.heading(table);
  for (const int order : plan.orders) {
    tasks.next(fmt::format("boundary integrals from the shape, p = {}", order));
    add_row(table, row_of(shape_level(problem, order, repeats)), observer);
  }
  for (const int degree : plan.element_degree_shape) {
    tasks.next(fmt::format("finite elements from the shape, k = {}", degree));
    add_row(table, row_of(fem(fem_degree, degree, coarse_cells, repeats)), observer);
  }
  return table;
}

}  // namespace

BenchResult bench_methods(const MethodsTask& task, const std::filesystem::path& folder, BenchObserver& observer) {
  // Each method has one core, and its processor time is measured: other programs on the machine do not matter.
  const ThreadCount one_thread(1);
  const LevelPlan plan = plan_of(task.quick);
  const int shape_order = plan.orders.back();
  FemLevels fem(sources_problem, folder / "sources.h5");
  write_sources_input(fem.input(), example1_position(shape_order), example1_electric(), example1_sources());

  observer.note(
      fmt::format("Example 1 on shape (33), seconds of one core, up to {} repeats; errors: relative L2", task.repeats));
  BenchResult result{"methods",
                     machine_record(),
                     task.repeats,
                     {},
                     {empty_methods_table("rows", sources_problem, {"error of q", "error of f_E"})}};
  BenchTable& table = result.tables.front();
  BenchTasks tasks(static_cast<int>(2 * plan.orders.size() + plan.element_degree.size() + plan.cells_per_edge.size() +
                                    plan.element_degree_shape.size() + 2),
                   observer);
  observer.heading(table);
  const auto keep = [&](const MethodLevel& level) { add_row(table, row_of(level), observer); };
  for (const int order : plan.orders) {
    tasks.next(fmt::format("boundary integrals, p = {}", order));
    keep(sources_level(order, task.repeats));
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
  const double change = std::abs(far.first.l2 - compared.first.l2);
  observer.note(fmt::format("outer sphere at R = {:.3g}; at {:.3g} the error of q at k = {} changes by {:.0e}", radius,
                            fem.outer_radius, far.degree, change));
  result.facts = {
      {"problem", "Example 1: shape (33), sigma_i = 2, sigma_e = 1, six point sources"},
      {"seconds_are", "of one core, from the shape to q and f_E: tables, mesh, matrices, solve"},
      {"shape_order", shape_order},
      {"truncation_radius", radius},
      {"truncation_radius_second", fem.outer_radius},
      {"truncation_change_q", change},
      {"from_shape_problem",
       "q, f_E, f_b, lambda and v of shape (33) in a field and a shear from x and V_m; errors of v and lambda"},
      {"from_shape_reference_order", plan.reference_order}};
  result.tables.push_back(from_shape_table(plan, task.repeats, folder, tasks, observer));
  return result;
}

}  // namespace vehd

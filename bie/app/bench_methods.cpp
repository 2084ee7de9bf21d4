#include "bie/app/bench_methods.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <numeric>

#include "bie/app/bench_record.hpp"
#include "bie/app/check_input.hpp"
#include "bie/app/example1.hpp"
#include "bie/app/fem_program.hpp"
#include "bie/app/file_system.hpp"
#include "bie/app/gnuplot.hpp"
#include "bie/app/summary.hpp"
#include "bie/stepping/discretisation.hpp"

namespace vehd {
namespace {

const MethodCurve bie{"bie", "BIE, degree p rises"};
const MethodCurve fem_degree{"fem_degree", "FEM, degree k rises"};
const MethodCurve fem_mesh{"fem_mesh", "FEM, mesh refined, k = 2"};

/// Cells per edge of a block where the degree rises.
constexpr int coarse_cells = 3;
/// A level that has taken so many seconds is not repeated: its timing is long enough.
constexpr double enough_seconds = 4.0;

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

bool wants_repeat(const MethodLevel& level, int repeats) {
  return static_cast<int>(level.seconds.size()) < repeats &&
         std::accumulate(level.seconds.begin(), level.seconds.end(), 0.0) < enough_seconds;
}

MethodLevel bie_level(int order, int repeats) {
  MethodLevel level;
  level.curve = bie;
  level.degree = order;
  level.unknowns = std::int64_t{order + 1} * (order + 1);
  const int upsampling = NumericalSettings().upsampling;
  while (wants_repeat(level, repeats)) {
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
  FemLevels(const std::filesystem::path& directory, int shape_order)
      : input_(directory / "sources.h5"), result_(directory / "level.json") {
    write_sources_input(input_.path(), example1_position(shape_order), example1_electric(), example1_sources());
  }

  double outer_radius = 0.0;

  MethodLevel operator()(const MethodCurve& curve, int degree, int cells_per_edge, int repeats,
                         double radius = near_radius) {
    MethodLevel level;
    level.curve = curve;
    level.degree = degree;
    level.cells_per_edge = cells_per_edge;
    while (wants_repeat(level, repeats)) {
      const ExitCode code = program_.run({"sources", input_.path().string(), "--degree", std::to_string(degree),
                                          "--cells", std::to_string(cells_per_edge), "--radius",
                                          fmt::format("{}", radius), "--json", result_.path().string()});
      if (code != ExitCode::done) throw std::runtime_error("the finite elements stopped, see above");
      const nlohmann::json json = nlohmann::json::parse(std::ifstream(result_.path()));
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
  TemporaryFile input_, result_;
};

std::string row_of(const MethodLevel& level) {
  const Spread seconds = spread_of(level.seconds);
  return fmt::format("{:<25} {:>6} {:>5} {:>9} {:>9.3f} {:>9.3f} {:>9.3f} {:>7.0f} {:>9.1e} {:>9.1e}\n",
                     level.curve.label, level.degree, level.cells_per_edge, level.unknowns, seconds.median, seconds.min,
                     seconds.max, static_cast<double>(level.peak_memory_bytes) / 1e6, level.charge_l2, level.force_l2);
}

std::string csv_of(const std::vector<MethodLevel>& levels) {
  std::string text =
      "method,degree,cells_per_edge,unknowns,seconds,seconds_min,seconds_max,memory_bytes,error_q,error_q_max,"
      "error_force,error_force_max\n";
  for (const MethodLevel& level : levels) {
    const Spread seconds = spread_of(level.seconds);
    text += fmt::format("{},{},{},{},{:.4g},{:.4g},{:.4g},{},{:.4g},{:.4g},{:.4g},{:.4g}\n", level.curve.name,
                        level.degree, level.cells_per_edge, level.unknowns, seconds.median, seconds.min, seconds.max,
                        level.peak_memory_bytes, level.charge_l2, level.charge_max, level.force_l2, level.force_max);
  }
  return text;
}

nlohmann::json json_of(const MethodLevel& level) {
  const Spread seconds = spread_of(level.seconds);
  return {{"method", level.curve.name},
          {"degree", level.degree},
          {"cells_per_edge", level.cells_per_edge},
          {"unknowns", level.unknowns},
          {"seconds", seconds.median},
          {"seconds_min", seconds.min},
          {"seconds_max", seconds.max},
          {"repeats", level.seconds.size()},
          {"memory_bytes", level.peak_memory_bytes},
          {"error_q", {{"l2", level.charge_l2}, {"max", level.charge_max}}},
          {"error_force", {{"l2", level.force_l2}, {"max", level.force_max}}}};
}

}  // namespace

nlohmann::json bench_methods(const MethodsTask& task) {
  std::error_code error;
  std::filesystem::create_directories(task.directory, error);
  if (error) throw OutputError(fmt::format("{}: cannot be created: {}", task.directory.string(), error.message()));
  const LevelPlan plan = plan_of(task.quick);
  const int shape_order = plan.orders.back();
  FemLevels fem(task.directory, shape_order);
  // Either method has one core, and its processor time counts: other programs on the machine then do not.
  omp_set_num_threads(1);

  fmt::print("Example 1 on shape (33), seconds of one core, up to {} repeats; errors: relative L2\n", task.repeats);
  fmt::print("{:<25} {:>6} {:>5} {:>9} {:>9} {:>9} {:>9} {:>7} {:>9} {:>9}\n", "method", "degree", "cells", "unknowns",
             "seconds", "min", "max", "MB", "error_q", "error_f_E");
  std::vector<MethodLevel> levels;
  const auto keep = [&](MethodLevel level) {
    fmt::print("{}", row_of(level));
    std::fflush(stdout);
    levels.push_back(std::move(level));
  };
  // Peak memory is that of the process so far: ascending orders make it that of the level.
  for (const int order : plan.orders) keep(bie_level(order, task.repeats));
  for (const int degree : plan.element_degree) keep(fem(fem_degree, degree, coarse_cells, task.repeats));
  for (const int cells : plan.cells_per_edge) keep(fem(fem_mesh, plan.element_degree.front(), cells, task.repeats));

  const double radius = fem.outer_radius;
  const auto compared = std::find_if(levels.rbegin(), levels.rend(), [](const MethodLevel& level) {
    return level.curve.name == fem_degree.name && level.degree <= highest_far_degree;
  });
  const MethodLevel far = fem(fem_degree, compared->degree, coarse_cells, 1, far_radius);
  const double change = std::abs(far.charge_l2 - compared->charge_l2);
  fmt::print("outer sphere at R = {:.3g}; at {:.3g} the error of q at k = {} changes by {:.0e}\n", radius,
             fem.outer_radius, far.degree, change);

  nlohmann::json result = {{"problem", "Example 1: shape (33), sigma_i = 2, sigma_e = 1, six point sources"},
                           {"machine", machine_record()},
                           {"threads", 1},
                           {"repeats", task.repeats},
                           {"shape_order", shape_order},
                           {"truncation_radius", radius},
                           {"truncation_radius_second", fem.outer_radius},
                           {"truncation_change_q", change}};
  for (const MethodLevel& level : levels) result["levels"].push_back(json_of(level));
  replace_file(task.directory / "methods.csv", csv_of(levels));
  replace_file(task.directory / "methods.json", result.dump(2) + "\n");
  fmt::print("files: {}\n", task.directory.string());
  if (!task.plot) return result;
  try {
    draw_methods(task.directory, {bie, fem_degree, fem_mesh});
  } catch (const std::exception& problem) {
    spdlog::warn("no picture: {}", problem.what());
  }
  return result;
}

}  // namespace vehd

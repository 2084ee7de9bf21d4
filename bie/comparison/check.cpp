#include "bie/comparison/check.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bie/comparison/check_fields.hpp"
#include "bie/comparison/check_input.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// Highest degree of the quick estimate, unless two above the degree of the state is higher.
constexpr int highest_quick_order = 28;
/// The estimate doubles degrees up to this one, as low degrees cost little.
constexpr int highest_doubled_order = 24;
/// For strongly bent shapes a change by fewer degrees underestimates the error. Only this estimate solves with
/// operators beyond highest_order.
constexpr int least_further_degrees = 16;

/// Keeps the sample points at which both orders have values.
void keep_evaluated(CheckSamples& samples, CheckFields& a, CheckFields& b) {
  std::vector<Index> known;
  for (Index i = 0; i < samples.points.rows(); ++i) {
    const auto knows = [i](const CheckFields& fields) {
      return (fields.sample_potential.size() == 0 || std::isfinite(fields.sample_potential[i])) &&
             (fields.sample_velocity.size() == 0 || fields.sample_velocity.row(i).allFinite());
    };
    if (knows(a) && knows(b)) known.push_back(i);
  }
  samples.points = Matrix(samples.points(known, Eigen::all));
  samples.distance = Vector(samples.distance(known));
  for (CheckFields* fields : {&a, &b}) {
    if (fields->sample_potential.size() > 0) fields->sample_potential = Vector(fields->sample_potential(known));
    if (fields->sample_velocity.size() > 0)
      fields->sample_velocity = Matrix(fields->sample_velocity(known, Eigen::all));
    std::vector<bool> sides;
    for (const Index i : known) sides.push_back(fields->is_inside[static_cast<std::size_t>(i)]);
    fields->is_inside = std::move(sides);
  }
}

}  // namespace

int estimate_order(int order, bool quick) {
  // Boundary integrals cost little beside fine elements; their error must not limit the comparison.
  const int raised = std::max(quick ? std::min((3 * order + 1) / 2, highest_quick_order) : 2 * order, order + 2);
  return std::min(raised, std::max(2 * highest_doubled_order, order + least_further_degrees));
}

int free_processors(const std::string& load, int processors, int most) {
  double last_minute = 0.0, five_minutes = 0.0, fifteen_minutes = 0.0;
  int running = 0;
  if (!(std::istringstream(load) >> last_minute >> five_minutes >> fifteen_minutes >> running)) return most;
  // The last minute includes what has ended, such as the run that is checked; the running threads, of which one is of
  // this process, may be many only for a moment.
  const double others = std::min(last_minute, running - 1.0);
  return std::clamp(static_cast<int>(std::lround(processors - others)), 1, most);
}

namespace {

/// Each rank without a processor of its own slows all others down, as they wait for it at every step of a solve.
int n_ranks(const CheckTask& task) {
  if (task.n_ranks) return *task.n_ranks;
  // The coarse mesh has a few hundred cells: with more processes each would have too few.
  constexpr int most = 8;
  const int usable = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most);
  std::string load;
  std::getline(std::ifstream("/proc/loadavg"), load);
  return free_processors(load, static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN)), usable);
}

/// Runs the finite-element program, which solves the problem in the file and compares.
FemProgram::Result run_elements(const FemProgram& fem, const CheckTask& task, const std::filesystem::path& input,
                                int ranks) {
  std::vector<std::string> arguments{"check", input.string(), "-o", task.directory.string()};
  if (task.quick) arguments.emplace_back("--quick");
  if (task.required) arguments.insert(arguments.end(), {"--require", fmt::format("{}", *task.required)});
  return fem.run(arguments, ranks);
}

/// Solves by boundary integrals and writes the file for the finite elements.
void solve_by_integrals(const CheckTask& task, const std::filesystem::path& input) {
  const FrozenState& frozen = task.frozen;
  CheckProblem problem = check_problem(frozen);
  make_directory(task.directory);
  std::vector<int> orders, others;
  for (const VesicleState& vesicle : frozen.state.vesicles) {
    orders.push_back(order_of(vesicle.position.rows()));
    others.push_back(estimate_order(orders.back(), task.quick));
  }
  const auto solved_at = [&](const std::vector<int>& of_each) {
    try {
      std::vector<CheckFields> fields = check_fields(problem, of_each);
      if (task.on_solved) task.on_solved(fields.front());
      return fields;
    } catch (const ConvergenceError& error) {
      throw ConvergenceError(
          fmt::format("{}, boundary integrals of degree {}: {}", frozen.source, of_each.front(), error.what()));
    }
  };
  std::vector<CheckFields> at_order = solved_at(orders), for_error = solved_at(others);
  keep_evaluated(problem.samples, at_order.front(), for_error.front());
  std::optional<InTime> in_time;
  if (task.span) {
    in_time =
        InTime{*task.span, potential_in_time(frozen, *task.span, orders.front(), false),
               potential_in_time(frozen, *task.span, others.front(), true), change_by_finer_motion(frozen, *task.span)};
  }
  write_check_input(input, {problem, at_order, for_error, in_time ? &*in_time : nullptr});
}

}  // namespace

FemProgram::Result compare_methods(const FemProgram& fem, const CheckTask& task) {
  const std::filesystem::path input = task.directory / "check_input.h5";
  solve_by_integrals(task, input);
  return run_elements(fem, task, input, n_ranks(task));
}

FemProgram::Result write_volume_mesh(const FemProgram& fem, const MeshTask& task) {
  const TemporaryFolder folder("vehd-mesh");
  const std::filesystem::path input = folder.path() / "shape.h5", mesh = folder.path() / "mesh.msh";
  write_shape_input(input, task.shape);
  FemProgram::Result result = fem.run(
      {"mesh", input.string(), "-o", mesh.string(), "--family", task.family, "--refine", std::to_string(task.refine)});
  if (result.code == ExitCode::done) replace_file(task.output, text_of_file(mesh));
  return result;
}

}  // namespace vehd

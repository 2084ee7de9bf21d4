#include <fmt/format.h>

#include <map>

#include "bie/bench/benches.hpp"
#include "bie/bench/exact_problems.hpp"

namespace vehd {
namespace {

/// Errors that the paper reports for Example 1.
struct PaperErrors {
  double charge, force;
};
const std::map<int, PaperErrors> paper_errors{
    {12, {2.5e-3, 2.7e-2}}, {16, {3.0e-4, 9.7e-3}}, {24, {3.7e-5, 8.7e-4}}, {32, {2.3e-6, 2.2e-4}}};

BenchTable empty_space_table() {
  constexpr const char* kError = "{:.1e}";
  return {"rows",
          {{"order", "p"},
           {"unknowns", ""},
           {"error_q", "error of q", kError},
           {"error_force", "error of f_E", kError},
           {"iterations", "iterations"},
           {"seconds", "seconds", "{:.2g}", true},
           {"paper_error_q", "paper: q", kError},
           {"paper_error_force", "paper: f_E", kError},
           {"error_velocity", "error of v, prolate", kError},
           {"seconds_velocity", "seconds, prolate", "{:.2g}", true}}};
}

}  // namespace

BenchResult bench_space(const std::vector<int>& orders, int repeats, BenchObserver& observer) {
  BenchResult result{"space", machine_record(), repeats, {}, {empty_space_table()}};
  result.facts = {{"charge_problem", "Example 1: shape (33), sigma_i = 2, sigma_e = 1, six point sources"},
                  {"velocity_problem", "2:1 prolate pulled along and across its axis, poles of the grid off the axis"},
                  {"seconds_are", "from the shape to the fields, tables of the degree excluded"}};
  BenchTable& table = result.tables.front();
  BenchTasks tasks(static_cast<int>(orders.size()) * repeats, observer);
  observer.heading(table);
  for (const int order : orders) {
    std::vector<double> electric_seconds, stokes_seconds;
    Example1Result electric;
    SolvedProblem stokes;
    while (wants_repeat(electric_seconds, repeats)) {
      tasks.next(fmt::format("p = {}", order));
      electric = solve_example1(order);
      stokes = solve_translating_prolate(order);
      electric_seconds.push_back(electric.seconds);
      stokes_seconds.push_back(stokes.seconds);
    }
    BenchCell paper_q, paper_force;
    if (const auto paper = paper_errors.find(order); paper != paper_errors.end()) {
      paper_q = paper->second.charge;
      paper_force = paper->second.force;
    }
    add_row(table,
            {std::int64_t{order}, std::int64_t{order + 1} * (order + 1), electric.errors.charge, electric.errors.force,
             std::int64_t{electric.errors.report.iterations}, spread_of(electric_seconds), paper_q, paper_force,
             stokes.error, spread_of(stokes_seconds)},
            observer);
  }
  return result;
}

}  // namespace vehd

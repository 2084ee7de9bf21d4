#include <fmt/format.h>

#include <algorithm>
#include <array>
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

constexpr std::array kEqualErrors = {1e-4, 1e-7, 1e-10};
/// End of the search for a degree: as far beyond the requested ones as rates can be trusted to hold.
int highest_degree(const std::vector<int>& orders) {
  constexpr int kBeyond = 2, kLargest = 64;
  return std::min(kLargest, kBeyond * *std::max_element(orders.begin(), orders.end()));
}

/// Keeps the error of the solver negligible beside that of the degree.
constexpr double kSolved = 1e-13;

/// Cost of equal errors, for the comparison with other codes.
BenchTable equal_table(const std::vector<int>& orders, int repeats, BenchTasks& tasks, BenchObserver& observer) {
  BenchTable table{"equal",
                   {{"field", "field", "{}", false, 22},
                    {"error", "error", "{:.0e}"},
                    {"order", "p"},
                    {"error_there", "error at p", "{:.1e}"},
                    {"first_seconds", "first", "{:.2g}", true},
                    {"seconds", "seconds", "{:.2g}", true},
                    {"bytes", ""},
                    {"megabytes", "MB", "{:.0f}"}}};
  const auto force_of_example1 = [](int degree) {
    const Example1Result r = solve_example1(degree, 1, kSolved);
    return SolvedProblem{r.errors.force, r.seconds, r.first_seconds};
  };
  const std::array<ExactProblem, 2> problems = {ExactProblem{"f_E, Example 1", force_of_example1},
                                                ExactProblem{"velocity, 2:1 prolate", solve_translating_prolate}};
  constexpr int kLowest = 4;
  observer.heading(table);
  for (const ExactProblem& problem : problems) {
    for (const double error : kEqualErrors) {
      tasks.next(fmt::format("{}: {:.0e}", problem.field, error));
      const std::optional<DegreeOfError> found = degree_of_error(problem, error, kLowest, highest_degree(orders));
      std::vector<BenchCell> row(table.columns.size());
      row[0] = problem.field;
      row[1] = error;
      if (found) {
        std::vector<double> first_seconds, seconds;
        while (wants_repeat(first_seconds, repeats)) {
          const SolvedProblem solved = problem.solve(found->degree);
          first_seconds.push_back(solved.first_seconds);
          seconds.push_back(solved.seconds);
        }
        row[2] = std::int64_t{found->degree};
        row[3] = found->error;
        row[4] = spread_of(first_seconds);
        row[5] = spread_of(seconds);
        if (const auto bytes = memory_of([&] { static_cast<void>(problem.solve(found->degree)); })) {
          row[6] = *bytes;
          row[7] = static_cast<double>(*bytes) / 1e6;
        }
      }
      add_row(table, std::move(row), observer);
    }
  }
  return table;
}

}  // namespace

BenchResult bench_space(const std::vector<int>& orders, int repeats, BenchObserver& observer) {
  BenchResult result{"space", machine_record(), repeats, {}, {empty_space_table()}};
  result.facts = {{"charge_problem", "Example 1: shape (33), sigma_i = 2, sigma_e = 1, six point sources"},
                  {"velocity_problem", "2:1 prolate pulled along and across its axis, poles of the grid off the axis"},
                  {"seconds_are", "from the shape to the fields, tables of the degree excluded"}};
  BenchTable& table = result.tables.front();
  const int n_equal = 2 * static_cast<int>(kEqualErrors.size());
  BenchTasks tasks(static_cast<int>(orders.size()) * repeats + n_equal, observer);
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
  BenchTable equal = equal_table(orders, repeats, tasks, observer);
  result.tables.push_back(std::move(equal));
  return result;
}

}  // namespace vehd

#include "fem_check/app/level_loop.hpp"

#include <fmt/format.h>

#include <limits>

namespace vehd::fem_check {

double largest_change(const Level& a, const Level& b, const std::vector<std::string>& fields) {
  double largest = 0.0;
  for (const std::string& name : fields) {
    const auto found = b.surface.find(name);
    if (found == b.surface.end()) continue;
    const double size = std::max(found->second.norm(), std::numeric_limits<double>::min());
    largest = std::max(largest, (a.surface.at(name) - found->second).norm() / size);
  }
  return largest;
}

Level level_of(const std::string& problem, const Discretisation& discretisation, const Cost& cost,
               std::chrono::steady_clock::time_point start) {
  Level level;
  level.problem = problem;
  level.degree = discretisation.degree();
  level.n_cells = discretisation.n_cells();
  level.n_unknowns = cost.n_unknowns;
  level.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  level.peak_memory_bytes = cost.peak_memory_bytes;
  return level;
}

std::string level_line(const Level& level) {
  return fmt::format("finite elements: {}, degree {}, outer radius {:.3g}: {} unknowns, {:.1f} s", level.problem,
                     level.degree, level.outer_radius, level.n_unknowns, level.seconds);
}

}  // namespace vehd::fem_check

#include "bie/linear/solve_report.hpp"

#include <fmt/format.h>

#include "bie/support/errors.hpp"

namespace vehd {

std::string text_of(SolveEnd end) {
  switch (end) {
    case SolveEnd::converged:
      return "converged";
    case SolveEnd::out_of_iterations:
      return "out of iterations";
    case SolveEnd::stagnated:
      return "stagnated";
    case SolveEnd::not_finite:
      return "not finite";
  }
  return {};
}

void require_converged(const SolveReport& report, const std::string& what) {
  if (report.end == SolveEnd::not_finite) {
    throw ConvergenceError(fmt::format("{}: the equations hold numbers that are not finite", what));
  }
  if (!report.converged()) {
    throw ConvergenceError(
        fmt::format("{}: the solve did not converge ({}), relative residual {:.2e} after {} iterations", what,
                    text_of(report.end), report.residual, report.iterations));
  }
}

}  // namespace vehd

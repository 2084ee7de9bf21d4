#include "bie/bench/shape_flow_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/comparison/check_input.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {
namespace {

/// docs/checks/shape33.toml at another degree.
std::string scene_of(int order) {
  return fmt::format(
      "[shape]\nkind = 'radial'\nbase = 1.0\namplitude = 0.2\nexponent = -3.0\nmodes = [{{n = 3, m = 2, a = 1.0}}]\n"
      "[membrane]\nbending_modulus = 0.1\ncapacitance = 1.0\nconductance = 5.0\n"
      "[electric]\nfield = [0.3, 0.5, 1.0]\nconductivity_in = 2.0\nconductivity_out = 1.0\ninitial_Vm = 'steady'\n"
      "[flow]\nkind = 'shear'\nrate = 1.0\n[numerics]\ndegree = {}\ndt = 0.02\nend_time = 0.0\n",
      order);
}

}  // namespace

ShapeFlowProblem::ShapeFlowProblem(int reference_order)
    : problem_(check_problem(read_frozen_state({"shape33.toml", {}, scene_of(reference_order)}, std::nullopt))) {
  problem_.samples = {};
  reference_ = check_fields(problem_, {reference_order});
}

SolvedFields ShapeFlowProblem::solve(int order) const {
  Instruments instruments;
  const FrozenState& frozen = problem_.frozen;
  return solve_fields(frozen.model, Discretisation(settings_at(frozen, order)), resized(frozen.state, order),
                      instruments);
}

MethodError ShapeFlowProblem::error_of(const Matrix& found, const Matrix& exact, const Matrix& background) const {
  Instruments instruments;
  const MembraneSpace space(settings_at(problem_.frozen, reference_.front().order), {});
  const Matrix& position = problem_.frozen.state.vesicles.front().position;
  const Membrane membrane = membrane_at(space, position, {}, 1.0, instruments);
  const auto sizes = [&](const Matrix& coefficients) -> MethodError {
    const Vector squares = membrane.fine.synthesize(coefficients).rowwise().squaredNorm();
    // The coefficient of Y_00 is the integral up to a factor that cancels in the ratios below.
    return {std::sqrt(membrane.weighted(squares)(0, 0)), std::sqrt(squares.maxCoeff())};
  };
  const MethodError difference = sizes(resize_order(found, reference_.front().order) - exact),
                    whole = sizes(exact - background);
  return {difference.l2 / whole.l2, difference.max / whole.max};
}

ShapeFlowErrors ShapeFlowProblem::errors_of(const SolvedFields& solved) const {
  const VesicleFields& fields = solved.fields.vesicles.front();
  const Matrix background =
      problem_.frozen.state.vesicles.front().position * flow_gradient(problem_.frozen).transpose();
  return {error_of(fields.velocity, reference_.front().velocity_of_shape, background),
          error_of(fields.tension, reference_.front().tension, Matrix::Zero(reference_.front().tension.size(), 1))};
}

void ShapeFlowProblem::write_input(const std::filesystem::path& file) const {
  write_check_input(file, {problem_, reference_, reference_});
}

}  // namespace vehd

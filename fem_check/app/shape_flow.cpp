#include "fem_check/app/shape_flow.hpp"

#include <algorithm>
#include <optional>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/potential_levels.hpp"
#include "fem_check/app/shape_levels.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

FieldError error_of(const SurfacePoints& points, const Eigen::MatrixXd& found, const Eigen::MatrixXd& exact) {
  return {relative_l2(points, found, exact), relative_max(found, exact)};
}

}  // namespace

ShapeFlowResult run_shape_flow(const LevelTask& task) {
  const CheckInput input = read_check_inputs(task.input).front();
  if (!input.flow() || !input.physics.inextensible) {
    throw InputError(task.input.string() + ": has no flow of an inextensible membrane");
  }
  const Refinement refinement = Refinement::finest();
  const LevelSpace space(meshes::FrozenShape(input.position), task);
  const Discretisation& discretisation = space.discretisation();
  std::optional<PotentialSolution> potential;
  VectorOnSurface electric;
  if (input.electric()) {
    PotentialProblem problem = given_problem({input});
    problem.tolerance = refinement.potential_tolerance;
    potential = solve_potential(discretisation, problem);
    electric = [&](const SurfacePoints& points) { return potential->on_surface(points).force; };
  }
  const Solved solved = solve_shape_flow(input, discretisation, refinement, electric);

  ShapeFlowResult result{space.cost_so_far(), {}, {}};
  result.cost.n_unknowns = solved.cost.n_unknowns;
  result.cost.peak_memory_bytes = solved.cost.peak_memory_bytes;
  if (potential) {
    result.cost.n_unknowns += potential->cost().n_unknowns;
    result.cost.peak_memory_bytes = std::max(result.cost.peak_memory_bytes, potential->cost().peak_memory_bytes);
  }
  const SurfacePoints points = discretisation.quadrature_points(refinement.points_per_edge);
  const Eigen::MatrixXd background = input.physics.flow_gradient * points.position;
  result.velocity = error_of(points, solved.surface.at("velocity") - background,
                             SurfaceSeries(input.bie.velocity_of_shape)(points) - background);
  result.tension = error_of(points, solved.surface.at("tension"), SurfaceSeries(input.bie.tension)(points));
  return result;
}

nlohmann::json json_of(const ShapeFlowResult& result) {
  nlohmann::json json = json_of(result.cost);
  json["fields"] = {{"velocity", json_of(result.velocity)}, {"tension", json_of(result.tension)}};
  return json;
}

}  // namespace vehd::fem_check

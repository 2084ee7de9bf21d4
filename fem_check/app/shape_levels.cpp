#include "fem_check/app/shape_levels.hpp"

#include <utility>

#include "fem_check/bending.hpp"
#include "fem_check/inextensible_flow.hpp"
#include "meshes/frozen_shape.hpp"

namespace vehd::fem_check {
namespace {

/// Of the bending elements above that of the velocity: four derivatives of x would make f_b the largest error by far.
constexpr int further_degrees = 6;
/// Of f_b as a field above that of the velocity: it is rougher than all that follows from it.
constexpr int degrees_of_field = 3;

/// Flows with the force of the shape, with or without a tension.
class ShapeFlow {
 public:
  ShapeFlow(const CheckInput& input, const Refinement& refinement)
      : physics_(input.physics),
        centre_(meshes::FrozenShape(input.position).centroid()),
        tension_is_free_(input.bie.tension_is_free),
        points_per_edge_(refinement.points_per_edge) {}

  /// @param electric  f_E; empty: none
  [[nodiscard]] Solved solve(const Discretisation& space, const SolveSettings& settings,
                             const VectorOnSurface& electric) const {
    const SurfacePoints points = space.quadrature_points(points_per_edge_);
    Solved solved;
    VectorOnSurface bending;
    if (physics_.bending_modulus > 0.0) {
      const double modulus = physics_.bending_modulus;
      const int degree = space.degree() + further_degrees;
      const auto field = [&](double curvature) {
        return bending_field(space, {modulus, curvature}, space.degree() + degrees_of_field, degree)(points);
      };
      const double curvature = physics_.spontaneous_curvature;
      solved.surface["bending"] = field(0.0);
      if (curvature != 0.0) solved.surface["spontaneous_curvature"] = field(curvature) - solved.surface["bending"];
      bending = bending_force(space, {modulus, curvature}, degree);
    }
    FlowProblem problem = problem_with(settings);
    problem.gradient = physics_.flow_gradient;
    problem.force = [&](const SurfacePoints& at) {
      Vectors force = at.normal * (physics_.weight.transpose() * (at.position.colwise() - centre_)).asDiagonal();
      if (bending) force += bending(at);
      if (electric) force -= electric(at);
      return force;
    };
    add_flow(space, problem, points, solved);
    return solved;
  }

  /// Of f_E alone, in a fluid at rest.
  [[nodiscard]] Solved solve_electric(const Discretisation& space, const SolveSettings& settings,
                                      const VectorOnSurface& electric) const {
    FlowProblem problem = problem_with(settings);
    problem.force = [&](const SurfacePoints& at) { return Vectors(-electric(at)); };
    Solved solved;
    add_flow(space, problem, space.quadrature_points(points_per_edge_), solved);
    return solved;
  }

 private:
  [[nodiscard]] FlowProblem problem_with(const SolveSettings& settings) const {
    FlowProblem problem;
    problem.viscosity_in = physics_.viscosity_in;
    problem.viscosity_out = physics_.viscosity_out;
    problem.tolerance = settings.tolerance;
    problem.exterior_degree = settings.exterior_degree;
    return problem;
  }

  void add_flow(const Discretisation& space, const FlowProblem& problem, const SurfacePoints& points,
                Solved& solved) const {
    if (!physics_.inextensible) {
      const FlowSolution flow = solve_flow(space, problem);
      solved.cost = flow.cost();
      solved.surface["velocity"] = flow.on_surface(points).velocity;
      return;
    }
    const InextensibleFlow found = solve_inextensible_flow(space, problem);
    solved.cost = found.flow().cost();
    solved.surface["velocity"] = found.flow().on_surface(points).velocity;
    Vector tension = found.tension(points);
    if (tension_is_free_) tension.array() -= tension.dot(points.weight) / points.weight.sum();
    solved.surface["tension"] = tension.transpose();
  }

  const Physics& physics_;
  Vector3 centre_;  // the weight is taken about it, which changes the pressure inside alone
  bool tension_is_free_;
  int points_per_edge_;
};

}  // namespace

Solved solve_shape_flow(const CheckInput& input, const Discretisation& space, const Refinement& refinement,
                        const VectorOnSurface& electric) {
  return ShapeFlow(input, refinement).solve(space, {refinement.flow_tolerance}, electric);
}

LevelSequence solve_shape_levels(const CheckInput& input, const Meshes& meshes, const Refinement& refinement,
                                 const PotentialLevels* potential, const Report& report) {
  const ShapeFlow flow(input, refinement);
  VectorOnSurface electric;
  if (potential != nullptr) {
    electric = [&](const SurfacePoints& at) { return potential->solutions.back().on_surface(at).force; };
  }
  const LevelPlan plan{shape_flow_problem,
                       {refinement.flow_first, refinement.flow_last},
                       refinement.flow_tolerance,
                       refinement.flow_target,
                       {"velocity", "tension"}};
  LevelSequence sequence =
      run_levels(plan, meshes, report, [&](const Discretisation& space, const SolveSettings& settings) {
        return flow.solve(space, settings, electric);
      });
  if (potential == nullptr) return sequence;

  const PotentialSolution& before = potential->solutions[potential->solutions.size() - 2];
  const VectorOnSurface change = [&](const SurfacePoints& at) {
    return Vectors(electric(at) - before.on_surface(at).force);
  };
  const Level moved = solve_level(
      "flow by the change of f_E", meshes.discretise(refinement.flow_first), meshes.outer_radius(), report,
      [&](const Discretisation& space) { return flow.solve_electric(space, {refinement.flow_tolerance}, change); });
  for (const auto& [name, values] : moved.surface)
    sequence.levels[sequence.levels.size() - 2].surface.at(name) += values;
  return sequence;
}

}  // namespace vehd::fem_check

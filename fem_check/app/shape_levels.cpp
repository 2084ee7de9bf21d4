#include "fem_check/app/shape_levels.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "fem_check/bending.hpp"
#include "fem_check/inextensible_flow.hpp"
#include "meshes/frozen_shape.hpp"

namespace vehd::fem_check {
namespace {

/// Degree of the bending elements minus that of the velocity: four derivatives of x would make f_b the largest error.
constexpr int bending_degrees = 6;
/// Degree of f_b as a field minus that of the velocity: f_b is rougher than all fields derived from it.
constexpr int bending_field_degrees = 3;

/// Bending forces of the shapes on elements of one degree.
struct Bending {
  FieldValues fields{};     ///< bending, spontaneous_curvature
  VectorOnSurface force{};  ///< sum of both fields, in the trace space of the flow
  long n_unknowns = 0;
};

/// Bending with the modulus and spontaneous curvature of each membrane.
Bending bending_of(const std::vector<CheckInput>& inputs, const Discretisation& space, int points_per_edge) {
  std::vector<BendingEnergy> flat, curved;
  for (const CheckInput& input : inputs) {
    flat.push_back({input.physics.bending_modulus, 0.0});
    curved.push_back({input.physics.bending_modulus, input.physics.spontaneous_curvature});
  }
  const auto any = [&](double BendingEnergy::*number) {
    return std::ranges::any_of(curved, [&](const BendingEnergy& of) { return of.*number != 0.0; });
  };
  if (!any(&BendingEnergy::modulus)) return {};
  const SurfacePoints points = space.quadrature_points(points_per_edge);
  const int surface_degree = space.degree() + bending_degrees, field_degree = space.degree() + bending_field_degrees;
  const BendingForce plain(space, flat, surface_degree);
  Bending bending{{{"bending", plain.field(field_degree)(points)}}, plain.on_trace(), plain.n_unknowns()};
  if (!any(&BendingEnergy::spontaneous_curvature)) return bending;
  const BendingForce whole(space, curved, surface_degree);
  bending.fields["spontaneous_curvature"] = whole.field(field_degree)(points) - bending.fields["bending"];
  bending.force = whole.on_trace();
  return bending;
}

/// Flows under the forces of the shape, with or without tension, on discretisations of one mesh.
class ShapeFlow {
 public:
  ShapeFlow(const CheckInput& input, FlowSetups& setups, const Refinement& refinement)
      : input_(input),
        physics_(input.physics),
        setups_(setups),
        centre_(meshes::FrozenShape(input.position).centroid()),
        points_per_edge_(refinement.points_per_edge) {}

  /// @param electric  f_E; empty: none
  [[nodiscard]] Solved solve(const Discretisation& space, const SolveSettings& settings,
                             const VectorOnSurface& electric) {
    Solved solved;
    const Bending& bending = bending_on(space);
    solved.surface = bending.fields;
    FlowProblem problem = problem_with(settings);
    problem.gradient = physics_.flow_gradient;
    problem.dilation = input_.bie_high.dilation;
    problem.force = [&](const SurfacePoints& at) {
      Vectors force = at.normal * (physics_.weight.transpose() * (at.position.colwise() - centre_)).asDiagonal();
      if (bending.force) force += bending.force(at);
      if (electric) force -= electric(at);
      return force;
    };
    if (physics_.inextensible) {
      inextensible_.push_back(solve_inextensible_flow(tension_on(space), problem, start_of(inextensible_, settings)));
      add(space, inextensible_.back(), solved);
    } else {
      flows_.push_back(solve_flow(setups_.at(space), problem, start_of(flows_, settings)));
      add(space, flows_.back(), solved);
    }
    return solved;
  }

  /// Flow due to f_E without a background flow.
  [[nodiscard]] Solved solve_electric(const Discretisation& space, const SolveSettings& settings,
                                      const VectorOnSurface& electric) {
    FlowProblem problem = problem_with(settings);
    problem.force = [&](const SurfacePoints& at) { return Vectors(-electric(at)); };
    Solved solved;
    if (physics_.inextensible) {
      add(space, solve_inextensible_flow(tension_on(space), problem), solved);
    } else {
      add(space, solve_flow(setups_.at(space), problem), solved);
    }
    return solved;
  }

 private:
  [[nodiscard]] FlowProblem problem_with(const SolveSettings& settings) const {
    FlowProblem problem = setups_.problem();
    problem.tolerance = settings.tolerance;
    problem.exterior_degree = settings.exterior_degree;
    return problem;
  }

  /// Operators, set up once for each degree.
  [[nodiscard]] const InextensibleOperators& tension_on(const Discretisation& space) {
    const auto found = tension_.find(space.degree());
    if (found != tension_.end()) return found->second;
    return tension_.emplace(space.degree(), InextensibleOperators(space, setups_.at(space))).first->second;
  }

  /// Bending forces, computed once for each degree.
  [[nodiscard]] const Bending& bending_on(const Discretisation& space) {
    const auto found = bending_.find(space.degree());
    if (found != bending_.end()) return found->second;
    return bending_.emplace(space.degree(), bending_of({input_}, space, points_per_edge_)).first->second;
  }

  void add(const Discretisation& space, const FlowSolution& flow, Solved& solved) const {
    solved.cost = flow.cost();
    solved.surface["velocity"] = flow.on_surface(space.quadrature_points(points_per_edge_)).velocity;
  }
  void add(const Discretisation& space, const InextensibleFlow& found, Solved& solved) const {
    add(space, found.flow(), solved);
    const SurfacePoints points = space.quadrature_points(points_per_edge_);
    Vector tension = found.tension(points);
    if (input_.bie.tension_is_free) tension.array() -= tension.dot(points.weight) / points.weight.sum();
    solved.surface["tension"] = tension.transpose();
  }

  const CheckInput& input_;
  const Physics& physics_;
  FlowSetups& setups_;
  Vector3 centre_;  // reference point of the weight, which only changes the pressure inside
  int points_per_edge_;
  std::map<int, Bending> bending_;                // by degree
  std::map<int, InextensibleOperators> tension_;  // by degree
  // Previous solutions, of one kind only.
  std::vector<FlowSolution> flows_;
  std::vector<InextensibleFlow> inextensible_;
};

}  // namespace

Solved solve_shape_flow(const CheckInput& input, const Discretisation& space, const Refinement& refinement,
                        const VectorOnSurface& electric) {
  FlowSetups setups({input});
  return ShapeFlow(input, setups, refinement).solve(space, {refinement.flow_tolerance}, electric);
}

namespace {

LevelSequence solve_bending_levels(const std::vector<CheckInput>& inputs, Meshes& meshes, const Refinement& refinement,
                                   const Report& report) {
  LevelSequence result;
  for (const int degree : refinement.shape_flow_degrees) {
    const auto solve = [&](const Discretisation& space) {
      Bending bending = bending_of(inputs, space, refinement.points_per_edge);
      return Solved{{.n_unknowns = bending.n_unknowns}, std::move(bending.fields), {}};
    };
    Level level = solve_level(bending_problem, meshes.discretise(degree), meshes.outer_radius(), report, solve);
    if (level.surface.empty()) return {};
    result.levels.push_back(std::move(level));
  }
  return result;
}

}  // namespace

LevelSequence solve_shape_levels(const std::vector<CheckInput>& inputs, Meshes& meshes, FlowSetups& setups,
                                 const Refinement& refinement, const PotentialLevels* potential, const Report& report) {
  if (inputs.size() > 1) return solve_bending_levels(inputs, meshes, refinement, report);
  ShapeFlow flow(inputs.front(), setups, refinement);
  VectorOnSurface electric;
  if (potential != nullptr) {
    electric = [&](const SurfacePoints& at) { return potential->solutions.back().on_surface(at).force; };
  }
  const LevelPlan plan{shape_flow_problem,
                       refinement.shape_flow_degrees,
                       refinement.flow_tolerance,
                       refinement.flow_target,
                       {"velocity", "tension"}};
  LevelSequence sequence =
      run_levels(plan, meshes, report, [&](const Discretisation& space, const SolveSettings& settings) {
        return flow.solve(space, settings, electric);
      });
  if (potential == nullptr) return sequence;

  const PotentialSolution& before = potential->solutions[potential->solutions.size() - 2];
  const double tail = tail_of_force(*potential);
  const VectorOnSurface change = [&](const SurfacePoints& at) {
    return Vectors(tail * (electric(at) - before.on_surface(at).force));
  };
  const Level moved = solve_level("flow by the change of f_E", meshes.discretise(refinement.shape_flow_degrees.front()),
                                  meshes.outer_radius(), report, [&](const Discretisation& space) {
                                    return flow.solve_electric(
                                        space, {std::max(refinement.flow_tolerance, tolerance_of_changes)}, change);
                                  });
  for (const auto& [name, values] : moved.surface)
    sequence.levels[sequence.levels.size() - 2].surface.at(name) += values;
  return sequence;
}

}  // namespace vehd::fem_check

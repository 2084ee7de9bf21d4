#include "fem_check/app/bending_levels.hpp"

#include <algorithm>

#include "fem_check/app/level_loop.hpp"
#include "fem_check/bending.hpp"

namespace vehd::fem_check {
namespace {

/// Each membrane with its own modulus.
Solved bending_of(const std::vector<CheckInput>& inputs, const Discretisation& space, int points_per_edge) {
  const SurfacePoints points = space.quadrature_points(points_per_edge);
  Eigen::MatrixXd bending = Eigen::MatrixXd::Zero(3, points.size());
  Cost cost;
  for (std::size_t a = 0; a < inputs.size(); ++a) {
    const double modulus = inputs[a].physics.bending_modulus;
    if (!(modulus > 0.0)) continue;
    const std::vector<Eigen::Index> own = points.of_vesicle(static_cast<int>(a));
    const BendingForce force(space, {modulus, 0.0}, space.degree() + bending_degrees);
    bending(Eigen::all, own) = force.field(space.degree() + bending_field_degrees)(points.picked(own));
    cost.n_unknowns = force.n_unknowns();
  }
  return {cost, {{"bending", bending}}, {}};
}

}  // namespace

LevelSequence solve_bending_levels(const std::vector<CheckInput>& inputs, Meshes& meshes, const Refinement& refinement,
                                   const Report& report) {
  LevelSequence result;
  const auto bends = [](const CheckInput& input) { return input.physics.bending_modulus > 0.0; };
  if (std::ranges::none_of(inputs, bends)) return result;
  for (const int degree : refinement.shape_flow_degrees) {
    result.levels.push_back(solve_level(
        bending_problem, meshes.discretise(degree), meshes.outer_radius(), report,
        [&](const Discretisation& space) { return bending_of(inputs, space, refinement.points_per_edge); }));
  }
  return result;
}

}  // namespace vehd::fem_check

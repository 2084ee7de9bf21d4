#include "fem_check/app/charging_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "fem_check/app/surface_series.hpp"
#include "fem_check/app/surface_transport.hpp"
#include "fem_check/backward_differentiation.hpp"
#include "fem_check/potential.hpp"
#include "meshes/oriented_mesh.hpp"

namespace vehd::fem_check {
namespace {

/// E_∞ between two discontinuities.
class FieldPiece {
 public:
  FieldPiece(const InTime& in_time, Eigen::Index number)
      : in_time_(in_time), first_(number * (in_time.intervals + 1)), last_(first_ + in_time.intervals) {}

  [[nodiscard]] double begin() const { return in_time_.field_times[first_]; }
  [[nodiscard]] double end() const { return in_time_.field_times[last_]; }
  /// E_∞ at a multiple of an interval.
  [[nodiscard]] Vector3 at(double time) const {
    const double share = (time - begin()) / (end() - begin());
    return in_time_.field.col(first_ + static_cast<Eigen::Index>(std::lround(share * in_time_.intervals)));
  }

 private:
  const InTime& in_time_;
  Eigen::Index first_, last_;
};

Eigen::Index number_of_pieces(const InTime& in_time) { return in_time.field_times.size() / (in_time.intervals + 1); }

}  // namespace

ChargingRun::ChargingRun(const CheckInput& input, const Refinement& refinement)
    : input_(input),
      refinement_(refinement),
      in_directions_(meshes::best_axes(meshes::FrozenShape(input.position)).in_directions) {}

Discretisation ChargingRun::discretise(const Eigen::MatrixXd& position, const Discretisation& like) const {
  const meshes::FrozenShape shape(position);
  std::shared_ptr<const meshes::VolumeMesh> mesh;
  if (input_.wall) {
    const meshes::FrozenShape end(input_.position);
    const meshes::Wall& wall = input_.wall->place;
    meshes::BoxMeshOptions options = wall_mesh_options(refinement_, shape, wall);
    // Every mesh has as many cells as the last one.
    options.box_layers = wall_mesh_options(refinement_, end, wall).box_layers;
    try {
      mesh = std::make_shared<meshes::BoxMesh>(meshes::make_mesh_beside_wall(shape, end, wall, options));
    } catch (const meshes::MeshError& error) {
      throw meshes::MeshError(fmt::format(
          "--from: beside a wall no mesh follows the membrane back from the checked snapshot; it may turn too far: {}",
          error.what()));
    }
  } else {
    mesh = std::make_shared<meshes::HexMesh>(meshes::make_block_mesh(shape, block_mesh_options(refinement_, shape),
                                                                     meshes::axes_along(shape, in_directions_)));
  }
  return {mesh, like.degree(), Ranks::all, like.points_per_edge()};
}

Solved ChargingRun::solve(const Discretisation& space, const ChargingPlan& plan) const {
  const InTime& in_time = *input_.in_time;
  PotentialProblem problem;
  problem.conductivity_in = input_.physics.conductivity_in;
  problem.conductivity_out = input_.physics.conductivity_out;
  if (input_.wall) problem.wall = input_.wall->field;
  problem.tolerance = plan.settings.tolerance;
  problem.exterior_degree = plan.settings.exterior_degree;
  // Points at which the steps represent V_m.
  const SurfacePoints rule = space.quadrature_points(space.points_per_edge());
  Vector value = SurfaceSeries(in_time.potential)(rule).row(0);
  std::optional<ChargingSteps> charging;
  for (Eigen::Index p = 0; p < number_of_pieces(in_time); ++p) {
    const FieldPiece piece(in_time, p);
    const TimeSteps steps{piece.begin(), piece.end(), plan.steps};
    problem.membrane =
        ChargingMembrane{input_.physics.capacitance, input_.physics.conductance, implicit_step(steps), 1, {}};
    if (plan.path == nullptr) charging.emplace(space, problem);
    TimeLaw law{[&](const Vector& from, double, double time) {
      if (plan.path != nullptr) {
        charging.emplace(discretise(plan.path->position(time), space), problem);
      }
      return charging->step(from, piece.at(time));
    }};
    if (plan.path != nullptr) {
      law.explicit_rate = [&](const Vector& now, double time) {
        return surface_transport(rule, SurfaceSeries(plan.path->position(time))(rule),
                                 SurfaceSeries(plan.path->sliding(time))(rule), now);
      };
    }
    value = advance(law, value, steps);
  }
  const SurfacePoints points = space.quadrature_points(refinement_.points_per_edge);
  return {charging->cost(), {{"Vm", charging->at(points, value).transpose()}}, {}};
}

}  // namespace vehd::fem_check

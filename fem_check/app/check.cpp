#include "fem_check/app/check.hpp"

#include <chrono>
#include <cmath>

#include "fem_check/app/field_files.hpp"
#include "fem_check/app/flow_levels.hpp"
#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/potential_levels.hpp"
#include "fem_check/app/questions.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

void add(CheckResult& result, const std::vector<FieldQuestion>& questions, const LevelSequence& sequence) {
  for (const FieldQuestion& question : questions) result.fields.push_back(compare(question, sequence));
  for (const Level& level : sequence.levels) result.levels.push_back(level);
}

/// Before the work, not after it.
void require_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!std::filesystem::is_directory(directory)) throw InputError(directory.string() + ": cannot be created");
}

double root_mean_square(const Eigen::MatrixXd& values, const Vector& weight) {
  return std::sqrt(values.colwise().squaredNorm().dot(weight) / weight.sum());
}

SurfaceDivergence divergence_of(const CheckInput& input, const LevelSequence& sequence, const Vector& weight,
                                double radius) {
  const Level& last = sequence.levels.back();
  const Eigen::MatrixXd& values = last.surface.at("divergence");
  const Eigen::MatrixXd change = values - sequence.levels[sequence.levels.size() - 2].surface.at("divergence");
  const double rate = std::max(
      input.physics.flow_gradient.norm() + root_mean_square(last.surface.at("velocity"), weight) / radius, 1e-300);
  const auto norms = [&](const Eigen::MatrixXd& field) {
    return Norms{root_mean_square(field, weight) / rate, field.cwiseAbs().maxCoeff() / rate};
  };
  return {norms(values), norms(change)};
}

}  // namespace

CheckResult run_check(const CheckTask& task, const Report& report) {
  const auto start = std::chrono::steady_clock::now();
  const CheckInput input = read_check_input(task.input);
  if (task.writes) require_directory(task.directory);
  const meshes::FrozenShape shape(input.position);
  const Meshes meshes(shape, task.refinement);
  // Fields are taken at the same points of γ on every level: those of the finest geometry that any level has.
  const Discretisation geometry = meshes.discretise(task.refinement.potential_last);
  const SurfacePoints points = geometry.quadrature_points(task.refinement.points_per_edge);

  CheckResult result;
  result.source = input.source;
  result.time = input.time;
  result.order = input.bie.order;
  result.high_order = input.bie_high.order;
  result.outer_radius = meshes.outer_radius();
  result.far_outer_radius = meshes.far_outer_radius();
  PotentialLevels potential;
  FlowLevels flow;
  FinestSolutions finest;
  if (input.electric()) {
    potential = solve_potential_levels(input, meshes, task.refinement, report);
    finest.potential = &potential;
    add(result, electric_questions(input, points, shape.radius(), task.refinement), potential.sequence);
  }
  if (input.flow()) {
    flow = solve_flow_levels(input, meshes, task.refinement, report);
    finest.flow = &flow;
    if (input.electric()) add_own_force(input, meshes, task.refinement, potential, flow.sequence, report);
    add(result, flow_questions(input, points, shape.radius(), task.refinement), flow.sequence);
    result.divergence = divergence_of(input, flow.sequence, points.weight, shape.radius());
    if (input.velocity.size() > 0) {
      const Eigen::MatrixXd own = SurfaceSeries(input.bie.velocity)(points);
      const Eigen::MatrixXd change = SurfaceSeries(input.velocity)(points) - own;
      result.stored_velocity =
          root_mean_square(change, points.weight) / std::max(root_mean_square(own, points.weight), 1e-300);
    }
  }
  if (task.writes) write_field_files(task.directory, input, finest, geometry);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace vehd::fem_check

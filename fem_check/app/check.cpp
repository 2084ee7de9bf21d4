#include "fem_check/app/check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "fem_check/app/compared_fields.hpp"
#include "fem_check/app/field_files.hpp"
#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/shape_levels.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

void add(CheckResult& result, const std::vector<ComparedField>& fields, const LevelSequence& sequence,
         const Requirement& required) {
  for (const ComparedField& compared : fields) result.fields.push_back(compare(compared, sequence, required));
}

/// Called before the computation, so that a failure is reported at once.
void require_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!std::filesystem::is_directory(directory)) throw InputError(directory.string() + ": cannot be created");
}

double root_mean_square(const Eigen::MatrixXd& values, const Vector& weight) {
  return std::sqrt(values.colwise().squaredNorm().dot(weight) / weight.sum());
}

SurfaceDivergence divergence_of(const CheckInput& input, const LevelSequence& sequence, const ComparisonPoints& at) {
  const Vector& weight = at.surface.weight;
  const Level& last = sequence.levels.back();
  const Eigen::MatrixXd& divergence = last.surface.at("divergence");
  const Eigen::MatrixXd values = (divergence.array() - input.bie.dilation).matrix();
  const Eigen::MatrixXd change = divergence - sequence.levels[sequence.levels.size() - 2].surface.at("divergence");
  const double rate = std::max(
      input.physics.flow_gradient.norm() + root_mean_square(last.surface.at("velocity"), weight) / at.radius, 1e-300);
  const auto norms = [&](const Eigen::MatrixXd& field) {
    return Norms{root_mean_square(field, weight) / rate, field.cwiseAbs().maxCoeff() / rate};
  };
  return {norms(values), norms(change)};
}

/// Relative difference of the snapshot's velocity from v of its truncated forces.
double stored_velocity_difference(const CheckInput& input, const SurfacePoints& points) {
  const Eigen::MatrixXd own = SurfaceSeries(input.bie.velocity)(points);
  const Eigen::MatrixXd change = SurfaceSeries(input.stored.velocity)(points) - own;
  return root_mean_square(change, points.weight) / std::max(root_mean_square(own, points.weight), 1e-300);
}

/// Refinement for the requested check: targets well below the required error, and cells that suit the curvature.
Refinement refinement_for(const CheckTask& task, const std::vector<CheckInput>& inputs,
                          const std::vector<meshes::FrozenShape>& shapes) {
  const bool single = shapes.size() == 1;
  Refinement refinement = Refinement::finest();
  if (task.quick) {
    refinement = single ? Refinement::quick_of(shapes.front()) : Refinement::quick_of_two();
  } else if (single) {
    refinement = Refinement::following(shapes.front());
  }
  for (const CheckInput& input : inputs) {
    for (const Eigen::MatrixXd* force : {&input.bie.force_bending, &input.bie_high.force_bending}) {
      if (force->size() > 0) refinement.resolve(degree_of(*force));
    }
  }
  constexpr double share = 0.5;
  refinement.potential_target = std::min(refinement.potential_target, share * task.required);
  refinement.flow_target = std::min(refinement.flow_target, share * task.required);
  refinement.charging_target = std::min(refinement.charging_target, share * task.required);
  return refinement;
}

}  // namespace

SolvedState solve_state(const std::vector<CheckInput>& inputs, Meshes& meshes, const Discretisation& geometry,
                        const Refinement& refinement, const Report& report) {
  const CheckInput& input = inputs.front();
  const meshes::FrozenShape shape(input.position);
  SolvedState solved;
  // Fields are evaluated at the same points of γ on every level: those of the finest geometry.
  solved.points = {geometry.quadrature_points(refinement.points_per_edge), shape.radius(), shape.centroid()};
  solved.outer_radius = meshes.outer_radius();
  const bool single = inputs.size() == 1;
  if (input.electric()) solved.potential = solve_potential_levels(inputs, meshes, refinement, report);
  if (input.in_time && single) solved.charging = solve_charging_levels(input, meshes, refinement, report);
  if (!input.flow()) return solved;
  FlowSetups setups(inputs);
  solved.flow = solve_flow_levels(inputs, meshes, setups, refinement, report);
  if (solved.potential) {
    add_own_force(inputs, meshes, setups, refinement, *solved.potential, solved.flow->sequence, report);
  }
  const PotentialLevels* potential = solved.potential ? &*solved.potential : nullptr;
  solved.shape_flow = solve_shape_levels(inputs, meshes, setups, refinement, potential, report);
  return solved;
}

namespace {

/// The part of the solutions on the membrane of one vesicle.
SolvedState part_of(const SolvedState& solved, const CheckInput& input, int number) {
  const std::vector<Eigen::Index> points = solved.points.surface.of_vesicle(number);
  const meshes::FrozenShape shape(input.position);
  SolvedState part = solved;
  part.points = {solved.points.surface.picked(points), shape.radius(), shape.centroid()};
  const auto pick = [&](Level& level) {
    for (auto& [name, values] : level.surface) values = Eigen::MatrixXd(values(Eigen::all, points));
  };
  const auto pick_all = [&](LevelSequence& sequence) {
    std::ranges::for_each(sequence.levels, pick);
    pick(sequence.truncated);
    pick(sequence.loose);
  };
  if (part.potential) pick_all(part.potential->sequence);
  if (part.flow) pick_all(part.flow->sequence);
  if (part.shape_flow) pick_all(*part.shape_flow);
  return part;
}

/// Result without rows.
CheckResult result_of(const CheckInput& input, const SolvedState& solved, double required) {
  CheckResult result;
  result.source = input.source;
  result.time = input.time;
  result.time_text = input.time_text;
  result.required = required;
  result.outer_radius = solved.outer_radius;
  return result;
}

/// @param solved  on the membrane of this vesicle only
CheckResult judge_vesicle(const CheckInput& input, const SolvedState& solved, double required_error) {
  CheckResult result = result_of(input, solved, required_error);
  const Requirement required{required_error, input.solver_tolerance};
  result.name = input.name;
  result.order = input.bie.order;
  result.high_order = input.bie_high.order;
  const ComparisonPoints& at = solved.points;
  if (solved.potential) {
    const LevelSequence& sequence = solved.potential->sequence;
    result.levels = sequence.levels;
    add(result, electric_fields(input, at, sequence), sequence, required);
    add(result, charging_currents(input, at), sequence, required);
    add(result, stored_electric_fields(input, at), sequence, required);
  }
  if (solved.charging && input.in_time) {
    const ChargingLevels& charging = *solved.charging;
    result.levels.insert(result.levels.end(), charging.sequence.levels.begin(), charging.sequence.levels.end());
    add(result, {potential_in_time(input, at, charging)}, charging.sequence, required);
    result.in_time = {input.in_time->begin, input.in_time->begin_text, charging.steps, charging.order_in_time,
                      input.in_time->moves()};
  }
  if (solved.flow) {
    const LevelSequence& sequence = solved.flow->sequence;
    result.levels.insert(result.levels.end(), sequence.levels.begin(), sequence.levels.end());
    add(result, flow_fields(input, at, sequence), sequence, required);
    const LevelSequence none;
    const LevelSequence& of_shape = solved.shape_flow ? *solved.shape_flow : none;
    const Level* last = of_shape.levels.empty() ? nullptr : &of_shape.levels.back();
    add(result, stored_fields_of_shape(input, at, last), of_shape, required);
    add(result, stored_flow_fields(input, at), sequence, required);
    if (last != nullptr) {
      add(result, fields_of_shape(input, at, *last), of_shape, required);
      result.levels.insert(result.levels.end(), solved.shape_flow->levels.begin(), solved.shape_flow->levels.end());
    }
    result.divergence = divergence_of(input, sequence, at);
    result.stored_velocity = stored_velocity_difference(input, at.surface);
  }
  return result;
}

}  // namespace

CheckResult judge(const std::vector<CheckInput>& inputs, const SolvedState& solved, double required) {
  if (inputs.size() == 1) return judge_vesicle(inputs.front(), solved, required);
  CheckResult result = result_of(inputs.front(), solved, required);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const SolvedState part = part_of(solved, inputs[k], static_cast<int>(k));
    result.vesicles.push_back(judge_vesicle(inputs[k], part, required));
  }
  return result;
}

std::vector<CheckResult> run_check(const CheckTask& task, const Report& report) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<CheckInput> inputs = read_check_inputs(task.input);
  std::vector<std::vector<CheckInput>> further;
  for (const std::filesystem::path& path : task.further_inputs) further.push_back(read_check_inputs(path));
  require_directory(task.directory);
  std::vector<meshes::FrozenShape> shapes;
  for (const CheckInput& input : inputs) shapes.emplace_back(input.position);
  const Refinement refinement = refinement_for(task, inputs, shapes);
  std::optional<meshes::Wall> wall;
  if (inputs.front().wall) wall = inputs.front().wall->place;
  Meshes meshes(shapes, refinement, wall);
  const Discretisation& geometry = meshes.discretise(refinement.potential_degrees.back());
  const SolvedState solved = solve_state(inputs, meshes, geometry, refinement, report);

  std::vector<CheckResult> results;
  if (task.judges) {
    results.push_back(judge(inputs, solved, task.required));
    for (const std::vector<CheckInput>& other : further) results.push_back(judge(other, solved, task.required));
  }
  if (task.writes) {
    const FinestSolutions finest{solved.potential ? &*solved.potential : nullptr,
                                 solved.flow ? &*solved.flow : nullptr};
    write_field_files(task.directory, inputs, finest, geometry);
  }
  if (task.judges) {
    results.front().seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return results;
}

}  // namespace vehd::fem_check

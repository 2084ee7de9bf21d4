#include "fem_check/app/check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "fem_check/app/field_files.hpp"
#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/questions.hpp"
#include "fem_check/app/shape_levels.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

void add(CheckResult& result, const std::vector<FieldQuestion>& questions, const LevelSequence& sequence,
         const Requirement& required) {
  for (const FieldQuestion& question : questions) result.fields.push_back(compare(question, sequence, required));
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

SurfaceDivergence divergence_of(const CheckInput& input, const LevelSequence& sequence,
                                const ComparisonPlaces& places) {
  const Vector& weight = places.surface.weight;
  const Level& last = sequence.levels.back();
  const Eigen::MatrixXd& divergence = last.surface.at("divergence");
  const Eigen::MatrixXd values = (divergence.array() - input.bie.dilation).matrix();
  const Eigen::MatrixXd change = divergence - sequence.levels[sequence.levels.size() - 2].surface.at("divergence");
  const double rate = std::max(
      input.physics.flow_gradient.norm() + root_mean_square(last.surface.at("velocity"), weight) / places.radius,
      1e-300);
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
  solved.places = {geometry.quadrature_points(refinement.points_per_edge), shape.radius(), shape.centroid()};
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
class OneVesicle {
 public:
  OneVesicle(const SolvedState& solved, const CheckInput& input, int number)
      : points_(solved.places.surface.of_vesicle(number)), part_(solved) {
    const meshes::FrozenShape shape(input.position);
    part_.places = {solved.places.surface.picked(points_), shape.radius(), shape.centroid()};
    if (part_.potential) keep(part_.potential->sequence);
    if (part_.flow) keep(part_.flow->sequence);
    if (part_.shape_flow) keep(*part_.shape_flow);
  }
  [[nodiscard]] const SolvedState& part() const { return part_; }

 private:
  void keep(LevelSequence& sequence) const {
    for (Level& level : sequence.levels) keep(level);
    keep(sequence.truncated);
    keep(sequence.loose);
  }
  void keep(Level& level) const {
    for (auto& [name, values] : level.surface) values = Eigen::MatrixXd(values(Eigen::all, points_));
  }

  std::vector<Eigen::Index> points_;
  SolvedState part_;
};

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
  const ComparisonPlaces& places = solved.places;
  if (solved.potential) {
    const LevelSequence& sequence = solved.potential->sequence;
    result.levels = sequence.levels;
    add(result, electric_questions(input, places, sequence), sequence, required);
    add(result, current_questions(input, places), sequence, required);
    add(result, stored_electric_questions(input, places), sequence, required);
  }
  if (solved.charging && input.in_time) {
    const ChargingLevels& charging = *solved.charging;
    result.levels.insert(result.levels.end(), charging.sequence.levels.begin(), charging.sequence.levels.end());
    add(result, {in_time_question(input, places, charging)}, charging.sequence, required);
    result.in_time = {input.in_time->begin, input.in_time->begin_text, charging.steps, charging.order_in_time,
                      input.in_time->moves()};
  }
  if (solved.flow) {
    const LevelSequence& sequence = solved.flow->sequence;
    result.levels.insert(result.levels.end(), sequence.levels.begin(), sequence.levels.end());
    add(result, flow_questions(input, places, sequence), sequence, required);
    const LevelSequence none;
    const LevelSequence& of_shape = solved.shape_flow ? *solved.shape_flow : none;
    const Level* last = of_shape.levels.empty() ? nullptr : &of_shape.levels.back();
    add(result, stored_shape_questions(input, places, last), of_shape, required);
    add(result, stored_flow_questions(input, places), sequence, required);
    if (last != nullptr) {
      add(result, shape_questions(input, places, *last), of_shape, required);
      result.levels.insert(result.levels.end(), solved.shape_flow->levels.begin(), solved.shape_flow->levels.end());
    }
    result.divergence = divergence_of(input, sequence, places);
    result.stored_velocity = stored_velocity_difference(input, places.surface);
  }
  return result;
}

}  // namespace

CheckResult judge(const std::vector<CheckInput>& inputs, const SolvedState& solved, double required) {
  if (inputs.size() == 1) return judge_vesicle(inputs.front(), solved, required);
  CheckResult result = result_of(inputs.front(), solved, required);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const OneVesicle vesicle(solved, inputs[k], static_cast<int>(k));
    result.vesicles.push_back(judge_vesicle(inputs[k], vesicle.part(), required));
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

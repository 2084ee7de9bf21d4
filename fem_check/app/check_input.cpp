#include "fem_check/app/check_input.hpp"

#include <fmt/format.h>

#include <utility>

#include "fem_check/app/hdf5_input.hpp"

namespace vehd::fem_check {
namespace {

constexpr double schema_version = 6;

void require_schema(const Hdf5Input& file) {
  const double version = file.number("/", "schema_version");
  if (version != schema_version) {
    file.refuse(fmt::format("has schema version {:g}; accepted: {:g}", version, schema_version));
  }
}

/// Data of one vesicle in a file, with equal names at the top level (a single vesicle) or in its group.
class VesicleGroup {
 public:
  VesicleGroup(const Hdf5Input& file, std::string group) : file_(file), group_(std::move(group)) {}

  [[nodiscard]] bool has(const std::string& object) const { return file_.has(path(object)); }
  [[nodiscard]] Eigen::MatrixXd matrix(const std::string& dataset) const { return file_.matrix(path(dataset)); }
  [[nodiscard]] double number(const std::string& object, const std::string& attribute) const {
    return file_.number(path(object), attribute);
  }
  [[nodiscard]] std::string text(const std::string& object, const std::string& attribute) const {
    return file_.text(path(object), attribute);
  }
  [[noreturn]] void refuse(const std::string& problem) const { file_.refuse(problem); }
  [[nodiscard]] std::string path(const std::string& object) const {
    return group_.empty() ? object : object == "/" ? group_ : group_ + object;
  }

 private:
  const Hdf5Input& file_;
  std::string group_;
};

std::optional<InputWall> read_wall(const Hdf5Input& file) {
  if (!file.has("/wall")) return {};
  InputWall wall;
  wall.place = {file.matrix("/wall/point"), file.matrix("/wall/normal")};
  if (file.number("/wall", "stress_free") != 0.0) wall.flow = WallFlow::stress_free;
  if (file.number("/wall", "electrode") != 0.0) wall.field = WallField::electrode;
  return wall;
}

/// Groups of all vesicles.
std::vector<VesicleGroup> vesicle_groups(const Hdf5Input& file) {
  if (!file.has("/vesicles")) return {{file, ""}};
  std::vector<VesicleGroup> groups;
  const int n = static_cast<int>(file.number("/vesicles", "count"));
  if (n < 1) file.refuse(fmt::format("has {} vesicles; accepted: 1 or more", n));
  for (int k = 0; k < n; ++k) groups.emplace_back(file, fmt::format("/vesicles/{:02}", k));
  return groups;
}

Eigen::MatrixXd matrix_of_size(const VesicleGroup& file, const std::string& dataset, Eigen::Index rows,
                               Eigen::Index columns) {
  Eigen::MatrixXd values = file.matrix(dataset);
  if (values.rows() != rows || values.cols() != columns) {
    file.refuse(fmt::format("dataset {} is {} x {}, but must be {} x {}", file.path(dataset), values.cols(),
                            values.rows(), columns, rows));
  }
  return values;
}

Physics read_physics(const VesicleGroup& file) {
  Physics physics;
  physics.field = matrix_of_size(file, "/physics/field", 3, 1);
  physics.viscosity_in = file.number("/physics", "viscosity_in");
  physics.viscosity_out = file.number("/physics", "viscosity_out");
  physics.bending_modulus = file.number("/physics", "bending_modulus");
  physics.spontaneous_curvature = file.number("/physics", "spontaneous_curvature");
  physics.weight = matrix_of_size(file, "/physics/weight", 3, 1);
  physics.inextensible = file.number("/physics", "inextensible") != 0.0;
  // The file stores the transpose.
  physics.flow_gradient = matrix_of_size(file, "/physics/flow_gradient", 3, 3).transpose();
  if (!file.has("/given/Vm")) return physics;
  physics.conductivity_in = file.number("/physics", "conductivity_in");
  physics.conductivity_out = file.number("/physics", "conductivity_out");
  physics.permittivity_in = file.number("/physics", "permittivity_in");
  physics.permittivity_out = file.number("/physics", "permittivity_out");
  physics.capacitance = file.number("/physics", "capacitance");
  physics.conductance = file.number("/physics", "conductance");
  return physics;
}

Eigen::Index n_coefficients(int order) { return Eigen::Index{order + 1} * (order + 1); }

/// Required and optional fields of a group, [n_coefficients x components].
class Coefficients {
 public:
  Coefficients(const VesicleGroup& file, std::string group, int order)
      : file_(file), group_(std::move(group)), rows_(n_coefficients(order)) {}

  [[nodiscard]] Eigen::MatrixXd required(const std::string& name, Eigen::Index components) const {
    return matrix_of_size(file_, group_ + "/" + name, rows_, components);
  }
  [[nodiscard]] Eigen::MatrixXd optional(const std::string& name, Eigen::Index components) const {
    return file_.has(group_ + "/" + name) ? required(name, components) : Eigen::MatrixXd();
  }

 private:
  const VesicleGroup& file_;
  std::string group_;
  Eigen::Index rows_;
};

BieFields read_fields(const VesicleGroup& file, const std::string& group, const CheckInput& input) {
  BieFields fields;
  fields.order = static_cast<int>(file.number(group, "order"));
  const Coefficients of(file, group, fields.order);
  if (input.electric()) {
    fields.charge = of.required("q", 1);
    fields.force_electric = of.required("force_electric", 3);
    fields.potential_rate = of.required("Vm_rate", 1);
    fields.rate_truncation = of.optional("Vm_rate_truncation", 1);
    if (input.charged_faces()) {
      fields.potential_of_charges = of.required("Vm_of_charges", 1);
      fields.free_charge_rate = of.required("free_charge_rate", 1);
    }
    fields.steady_potential = of.optional("Vm_steady", 1);
    if (input.physics.field.norm() > 0.0 && input.conducts_alike())
      fields.steady_potential = of.required("Vm_steady", 1);
    if (fields.steady_potential.size() > 0) fields.steady_charge = of.required("q_steady", 1);
  }
  if (!input.flow()) return fields;
  const Coefficients of_local_forces(file, group, static_cast<int>(file.number(group, "force_order")));
  fields.velocity = of.required("velocity", 3);
  if (input.electric()) fields.velocity_own_force = of.required("velocity_own_force", 3);
  fields.velocity_of_shape = of.required("velocity_of_shape", 3);
  fields.velocity_truncation = of.optional("velocity_truncation", 3);
  if (input.physics.bending_modulus > 0.0) fields.force_bending = of_local_forces.required("force_bending", 3);
  fields.force_curvature = of_local_forces.optional("force_curvature", 3);
  if (!input.physics.inextensible) return fields;
  fields.force_tension = of.required("force_tension", 3);
  fields.tension = of.required("tension", 1);
  fields.tension_is_free = file.number(group, "tension_is_free") != 0.0;
  fields.dilation = file.number(group, "dilation");
  return fields;
}

StoredFields read_stored(const VesicleGroup& file, const CheckInput& input) {
  StoredFields stored;
  const Coefficients of(file, "/stored", static_cast<int>(file.number("/", "order")));
  if (input.electric()) {
    stored.charge = of.required("q", 1);
    stored.force_electric = of.required("force_electric", 3);
  }
  if (!input.flow()) return stored;
  stored.velocity = of.required("velocity", 3);
  if (input.physics.bending_modulus > 0.0) stored.force_bending = of.required("force_bending", 3);
  if (!input.physics.inextensible) return stored;
  stored.force_tension = of.required("force_tension", 3);
  stored.tension = of.required("tension", 1);
  return stored;
}

/// Reads the sample points and the values of both orders there.
void read_samples(const VesicleGroup& file, CheckInput& input) {
  if (!file.has("/samples")) return;
  Samples& samples = input.samples;
  const Eigen::MatrixXd points = file.matrix("/samples/points");
  samples.points = matrix_of_size(file, "/samples/points", points.rows(), 3).transpose();
  const Eigen::MatrixXd distance = file.matrix("/samples/distance"), inside = file.matrix("/samples/inside");
  if (distance.rows() != samples.points.cols() || inside.rows() != samples.points.cols()) {
    file.refuse("sample points, distances and sides differ in number");
  }
  for (Eigen::Index i = 0; i < samples.points.cols(); ++i) {
    samples.inside.push_back(inside(i, 0) > 0.0);
    samples.near.push_back(distance(i, 0) > 0.0);
  }
  const auto at_samples = [&](const std::string& dataset, Eigen::Index components) {
    return file.has(dataset) ? matrix_of_size(file, dataset, samples.points.cols(), components) : Eigen::MatrixXd();
  };
  const auto read_values = [&](const std::string& group, BieFields& fields) {
    if (input.electric()) fields.sample_potential = at_samples(group + "/sample_potential", 1);
    if (input.flow()) fields.sample_velocity = at_samples(group + "/sample_velocity", 3);
  };
  read_values("/bie", input.bie);
  read_values("/bie_high", input.bie_high);
  if (input.bie.sample_potential.size() != input.bie_high.sample_potential.size() ||
      input.bie.sample_velocity.size() != input.bie_high.sample_velocity.size()) {
    file.refuse("/bie and /bie_high differ in their fields at the sample points");
  }
}

InTime read_in_time(const VesicleGroup& file, const CheckInput& input) {
  InTime result;
  const std::string group = "/in_time";
  const auto of_order = [&](const std::string& name, int order) {
    return matrix_of_size(file, group + "/" + name, n_coefficients(order), 1);
  };
  result.begin = file.number(group, "begin");
  result.begin_text = file.text(group, "begin_text");
  result.intervals = static_cast<int>(file.number(group, "intervals"));
  result.fewest_steps = static_cast<int>(file.number(group, "fewest_steps"));
  result.field_times = file.matrix(group + "/field_times").col(0);
  const Eigen::Index n_times = result.field_times.size();
  result.field = matrix_of_size(file, group + "/field", n_times, 3).transpose();
  if (result.intervals < 1 || n_times == 0 || n_times % (result.intervals + 1) != 0) {
    file.refuse(fmt::format("has {} times of the field for pieces of {} intervals", n_times, result.intervals));
  }
  result.shape_times = file.matrix(group + "/shape_times").col(0);
  const Eigen::MatrixXd start = file.matrix(group + "/Vm");
  result.potential = matrix_of_size(file, group + "/Vm", start.rows(), 1);
  for (Eigen::Index i = 0; i < result.shape_times.size(); ++i) {
    const std::string shape = group + "/shapes/" + std::to_string(i);
    result.positions.push_back(file.matrix(shape + "/x"));
    if (result.shape_times.size() > 1) result.velocities.push_back(file.matrix(shape + "/velocity"));
  }
  result.bie = of_order("Vm_end", input.bie.order);
  result.bie_high = of_order("Vm_end_high", input.bie_high.order);
  if (file.has(group + "/Vm_change_by_motion")) result.by_motion = of_order("Vm_change_by_motion", input.bie.order);
  return result;
}

CheckInput read_vesicle(const VesicleGroup& file) {
  CheckInput input;
  const int order = static_cast<int>(file.number("/", "order"));
  input.position = Coefficients(file, "", order).required("x", 3);
  input.physics = read_physics(file);
  const Coefficients given(file, "/given", order);
  input.potential = given.optional("Vm", 1);
  input.conductance = given.optional("conductance", 1);
  input.pump_current = given.optional("pump_current", 1);
  input.free_charge_in = given.optional("free_charge_in", 1);
  if (input.charged_faces()) input.free_charge_out = given.required("free_charge_out", 1);
  input.force = given.optional("force", 3);
  if (!input.electric() && !input.flow()) file.refuse("has neither /given/Vm nor /given/force: nothing to compare");
  input.stored = read_stored(file, input);
  input.solver_tolerance = file.number("/", "solver_tolerance");
  input.bie = read_fields(file, "/bie", input);
  input.bie_high = read_fields(file, "/bie_high", input);
  read_samples(file, input);
  if (file.has("/in_time")) input.in_time = read_in_time(file, input);
  return input;
}

}  // namespace

std::vector<CheckInput> read_check_inputs(const std::filesystem::path& path) {
  const Hdf5Input file(path);
  require_schema(file);
  std::vector<CheckInput> inputs;
  const std::vector<VesicleGroup> groups = vesicle_groups(file);
  for (const VesicleGroup& group : groups) {
    CheckInput& input = inputs.emplace_back(read_vesicle(group));
    input.source = file.text("/", "source");
    input.time = file.number("/", "time");
    input.time_text = file.text("/", "time_text");
    input.wall = read_wall(file);
    const bool is_curved = input.flow() && input.physics.spontaneous_curvature != 0.0;
    if (is_curved && !(input.bie.force_curvature.size() > 0 && input.bie_high.force_curvature.size() > 0)) {
      file.refuse("has a spontaneous curvature and no force_curvature in /bie or /bie_high");
    }
    if (groups.size() > 1) input.name = group.text("/", "name");
    if (input.electric() != inputs.front().electric() || input.flow() != inputs.front().flow()) {
      file.refuse("vesicles differ in what is compared");
    }
  }
  return inputs;
}

std::string source_of(const std::filesystem::path& path) {
  const Hdf5Input file(path);
  return file.has_attribute("/", "source") ? file.text("/", "source") : path.string();
}

InputShapes read_shapes(const std::filesystem::path& path) {
  const Hdf5Input file(path);
  require_schema(file);
  InputShapes shapes;
  for (const VesicleGroup& group : vesicle_groups(file)) shapes.positions.push_back(group.matrix("/x"));
  if (const std::optional<InputWall> wall = read_wall(file)) shapes.wall = wall->place;
  return shapes;
}

}  // namespace vehd::fem_check

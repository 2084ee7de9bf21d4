#include "bie/comparison/check_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bie/files/hdf5_writer.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

/// Writes one vesicle: at the top of the file if it is the only one, otherwise in a group of its own.
class VesicleWriter {
 public:
  VesicleWriter(Hdf5Writer& file, std::string group) : file_(file), group_(std::move(group)) {}

  void group(const std::string& path) { file_.group(group_ + path); }
  void numbers(const std::string& path, std::span<const double> values, const std::vector<hsize_t>& extents,
               const DatasetLabel& label) {
    file_.numbers(group_ + path, values, extents, label);
  }
  void integers(const std::string& path, std::span<const std::int64_t> values, const std::vector<hsize_t>& extents,
                const DatasetLabel& label) {
    file_.integers(group_ + path, values, extents, label);
  }
  template <typename Value>
  void attribute(const std::string& object, const std::string& name, const Value& value) {
    file_.attribute(group_.empty() ? object : object == "/" ? group_ : group_ + object, name, value);
  }

 private:
  Hdf5Writer& file_;
  std::string group_;
};

/// Makes the group of each of several vesicles.
std::vector<VesicleWriter> writers_of(Hdf5Writer& file, std::size_t n_vesicles) {
  if (n_vesicles == 1) return {{file, ""}};
  file.group("/vesicles");
  file.attribute("/vesicles", "count", static_cast<std::int64_t>(n_vesicles));
  std::vector<VesicleWriter> writers;
  for (std::size_t a = 0; a < n_vesicles; ++a) {
    const std::string group = fmt::format("/vesicles/{:02}", a);
    file.group(group);
    writers.emplace_back(file, group);
  }
  return writers;
}

/// Column-major memory [n x components] is row-major [components, n] in the file.
void write(VesicleWriter& file, const std::string& path, const Matrix& values, const DatasetLabel& label) {
  if (values.size() == 0) return;
  std::vector<hsize_t> extents{static_cast<hsize_t>(values.rows())};
  if (values.cols() > 1) extents.insert(extents.begin(), static_cast<hsize_t>(values.cols()));
  file.numbers(path, {values.data(), static_cast<std::size_t>(values.size())}, extents, label);
}

void write_shape(VesicleWriter& file, const Matrix& position) {
  file.attribute("/", "order", std::int64_t{order_of(position.rows())});
  write(file, "/x", position, {"length", "coefficients of the membrane position"});
}

void write_wall(Hdf5Writer& file, const std::optional<Wall>& wall) {
  if (!wall) return;
  file.group("/wall");
  const auto write_vector = [&](const std::string& name, const Vector3& value, const DatasetLabel& label) {
    file.numbers("/wall/" + name, {value.data(), 3}, {3}, label);
  };
  write_vector("point", wall->point, {"length", "of the plane"});
  write_vector("normal", wall->normal, {"1", "into the fluid"});
  file.attribute("/wall", "stress_free", std::int64_t{wall->flow == WallFlow::stress_free});
  file.attribute("/wall", "electrode", std::int64_t{wall->field == WallField::electrode});
}

/// Effects on vesicles besides bending and tension, in the form used by the finite elements.
struct FurtherForces {
  double spontaneous_curvature = 0.0;
  Vector3 weight = Vector3::Zero();
};

FurtherForces further_forces(const VesicleModel& vesicle) {
  FurtherForces result;
  for (const auto& effect : vesicle.effects) {
    result.spontaneous_curvature += effect->spontaneous_curvature();
    result.weight += effect->weight();
  }
  return result;
}

void write_physics(VesicleWriter& file, const FrozenState& frozen, std::size_t a) {
  const Model& model = frozen.model;
  file.group("/physics");
  const auto number = [&](const std::string& name, double value) { file.attribute("/physics", name, value); };
  const VesicleModel& vesicle = model.vesicles[a];
  file.attribute("/physics", "inextensible", std::int64_t{vesicle.inextensible});
  number("bending_modulus", vesicle.bending ? vesicle.bending->modulus : 0.0);
  const FurtherForces further = further_forces(vesicle);
  number("spontaneous_curvature", further.spontaneous_curvature);
  const Matrix weight = further.weight;
  write(file, "/physics/weight", weight, {"force/volume", "density difference times acceleration"});
  number("viscosity_in", vesicle.viscosity_ratio * model.viscosity);
  number("viscosity_out", model.viscosity);
  const Matrix gradient = flow_gradient(frozen).transpose();
  write(file, "/physics/flow_gradient", gradient, {"velocity/length", "A(i, j) of v_i = A(i, j) x_j, in row i"});
  const Matrix field = electric_at(frozen).field;
  write(file, "/physics/field", field, {"potential/length", "E_inf"});
  if (!model.electric) return;
  number("conductivity_in", vesicle.inside.conductivity);
  number("conductivity_out", model.electric->conductivity);
  number("permittivity_in", vesicle.inside.permittivity_ratio * model.electric->permittivity);
  number("permittivity_out", model.electric->permittivity);
  number("capacitance", vesicle.charging.capacitance);
  number("conductance", vesicle.charging.conductance);
}

void write_given(VesicleWriter& file, const CheckProblem& problem, std::size_t a) {
  const FrozenState& frozen = problem.frozen;
  file.group("/given");
  const auto field = [&](const std::string& name, const Matrix& values, const DatasetLabel& label) {
    write(file, "/given/" + name, values, label);
  };
  if (problem.contents.electric) {
    const VesicleFields& fields = frozen.fields.vesicles[a];
    const VesicleState& state = frozen.state.vesicles[a];
    field("Vm", transmembrane_potential(state, fields), {"potential", "V_m of the snapshot"});
    field("conductance", fields.conductance.size() > 0 ? fields.conductance : state.material.conductance,
          {"conductance/area", "G_m where it varies"});
    field("pump_current", electric_at(frozen).pump * state.material.pump_current,
          {"current/area", "J_p at the time of the snapshot, outwards"});
    field("free_charge_in", fields.free_charge_in, {"charge/area", "q_i of the inner face"});
    field("free_charge_out", fields.free_charge_out, {"charge/area", "q_e of the outer face"});
  }
  if (problem.contents.flow) {
    field("force", problem.forces[a], {"force/area", "f on the fluid, f_b + f_lambda - f_E and others"});
  }
}

/// The fields of the snapshot that are checked.
void write_stored(VesicleWriter& file, const CheckProblem& problem, std::size_t a) {
  file.group("/stored");
  const VesicleFields& fields = problem.frozen.fields.vesicles[a];
  const auto field = [&](const std::string& name, const Matrix& values, const DatasetLabel& label) {
    write(file, "/stored/" + name, values, label);
  };
  if (problem.contents.electric) {
    field("q", fields.charge, {"potential/length", "q"});
    field("force_electric", fields.force_electric, {"force/area", "f_E"});
  }
  if (!problem.contents.flow) return;
  field("force_bending", fields.force_bending, {"force/area", "f_b"});
  field("force_tension", fields.force_tension, {"force/area", "f_lambda"});
  field("tension", fields.tension, {"force/length", "lambda"});
  field("velocity", fields.velocity, {"velocity", "dx/dt"});
}

void write_fields(VesicleWriter& file, const std::string& group, const CheckFields& fields) {
  file.group(group);
  file.attribute(group, "order", std::int64_t{fields.order});
  file.attribute(group, "force_order", std::int64_t{fields.force_order});
  file.attribute(group, "seconds", fields.seconds);
  const auto field = [&](const std::string& name, const Matrix& values, const DatasetLabel& label) {
    write(file, group + "/" + name, values, label);
  };
  field("q", fields.charge, {"potential/length", "q = [[d phi/d n]] of the given V_m"});
  field("force_electric", fields.force_electric, {"force/area", "f_E of the given V_m"});
  field("Vm_rate", fields.potential_rate,
        {"potential/time", "dV_m/dt of the given V_m, where C_m varies times it over the C_m of /physics"});
  field("Vm_rate_truncation", fields.rate_truncation,
        {"potential/time", "change of Vm_rate when G_m of pores is truncated to this degree"});
  field("Vm_of_charges", fields.potential_of_charges, {"potential", "V_m of the given free charges"});
  field("free_charge_rate", fields.free_charge_rate, {"potential/time", "rate of q_i + q_e over C_m"});
  field("force_bending", fields.force_bending, {"force/area", "f_b of the shape, in the degree force_order"});
  field("force_curvature", fields.force_curvature,
        {"force/area", "f_c of the spontaneous curvature and the shape, in the degree force_order"});
  field("force_tension", fields.force_tension, {"force/area", "f_lambda of the shape and the given V_m"});
  field("tension", fields.tension, {"force/length", "lambda of the shape and the given V_m"});
  field("velocity_of_shape", fields.velocity_of_shape, {"velocity", "v of the shape and the given V_m"});
  field("velocity_truncation", fields.velocity_truncation,
        {"velocity", "change of v when its forces are truncated to this degree"});
  file.attribute(group, "tension_is_free", std::int64_t{fields.tension_is_free});
  file.attribute(group, "dilation", fields.dilation);
  field("Vm_steady", fields.steady_potential, {"potential", "steady V_m of the membrane law"});
  field("q_steady", fields.steady_charge, {"potential/length", "q of the steady V_m"});
  field("velocity", fields.velocity, {"velocity", "v of the given force"});
  field("velocity_own_force", fields.velocity_own_force, {"velocity", "v with the f_E of this group in the force"});
  field("sample_potential", fields.sample_potential, {"potential", "phi at /samples/points, V_m given"});
  field("sample_velocity", fields.sample_velocity, {"velocity", "v at /samples/points, force given"});
}

/// @param inside  side of each point; empty if nothing was solved there
void write_samples(VesicleWriter& file, const CheckSamples& samples, const std::vector<bool>& inside) {
  if (inside.empty()) return;
  file.group("/samples");
  write(file, "/samples/points", samples.points, {"length", "points off the membrane"});
  write(file, "/samples/distance", samples.distance, {"length", "from the membrane, 0 where it is more than near"});
  file.attribute("/samples", "near", samples.near);
  file.integers("/samples/inside", std::vector<std::int64_t>(inside.begin(), inside.end()), {inside.size()},
                {"1", "1 inside, 0 outside"});
}

void write_numbers(VesicleWriter& file, const std::string& path, const std::vector<double>& values,
                   const DatasetLabel& label) {
  file.numbers(path, values, {values.size()}, label);
}

void write_in_time(VesicleWriter& file, const InTime& in_time) {
  const TimeSpan& span = in_time.span;
  file.group("/in_time");
  file.attribute("/in_time", "begin", span.begin);
  file.attribute("/in_time", "begin_text", span.begin_text);
  file.attribute("/in_time", "intervals", span.intervals);
  file.attribute("/in_time", "fewest_steps", span.fewest_steps);
  write(file, "/in_time/Vm", span.potential, {"potential", "V_m of the snapshot at the begin"});
  write_numbers(file, "/in_time/field_times", span.field_times,
                {"time", "evenly spaced between two discontinuities of the field, which are there twice"});
  write(file, "/in_time/field", span.field, {"potential/length", "E_inf at these times"});
  write_numbers(file, "/in_time/shape_times", span.shape_times, {"time", "of the snapshots in /in_time/shapes"});
  file.group("/in_time/shapes");
  for (std::size_t i = 0; i < span.positions.size(); ++i) {
    const std::string group = "/in_time/shapes/" + std::to_string(i);
    file.group(group);
    write(file, group + "/x", span.positions[i], {"length", "coefficients of the membrane position"});
    if (!span.velocities.empty()) write(file, group + "/velocity", span.velocities[i], {"velocity", "dx/dt"});
  }
  write(file, "/in_time/Vm_end", in_time.at_order, {"potential", "V_m at the end, shape held still, degree of /bie"});
  write(file, "/in_time/Vm_end_high", in_time.for_error,
        {"potential", "the same with finer steps, degree of /bie_high"});
  write(file, "/in_time/Vm_change_by_motion", in_time.by_motion,
        {"potential", "change of V_m by finer steps of the moving shape, degree of /bie"});
}

}  // namespace

void write_check_input(const std::filesystem::path& path, const CheckInput& input) {
  Hdf5Writer file(path, Hdf5Writer::Mode::create);
  const FrozenState& frozen = input.problem.frozen;
  file.attribute("/", "schema_version", check_schema_version);
  file.attribute("/", "source", frozen.source);
  file.attribute("/", "time", frozen.state.time);
  file.attribute("/", "time_text", frozen.time_text);
  write_wall(file, frozen.model.wall);
  std::vector<VesicleWriter> writers = writers_of(file, input.at_order.size());
  for (std::size_t a = 0; a < writers.size(); ++a) {
    VesicleWriter& writer = writers[a];
    if (writers.size() > 1) writer.attribute("/", "name", frozen.names.at(a));
    write_shape(writer, frozen.state.vesicles[a].position);
    writer.attribute("/", "solver_tolerance",
                     std::max(frozen.settings.flow_tolerance, frozen.settings.electric_tolerance));
    write_physics(writer, frozen, a);
    write_given(writer, input.problem, a);
    write_stored(writer, input.problem, a);
    write_fields(writer, "/bie", input.at_order[a]);
    write_fields(writer, "/bie_high", input.for_error[a]);
    write_samples(writer, input.problem.samples, input.at_order[a].is_inside);
    if (input.in_time != nullptr) write_in_time(writer, *input.in_time);
  }
  file.close();
}

void write_shape_input(const std::filesystem::path& path, const FrozenShape& shape) {
  const std::vector<Matrix>& positions = shape.positions;
  Hdf5Writer file(path, Hdf5Writer::Mode::create);
  file.attribute("/", "schema_version", check_schema_version);
  file.attribute("/", "source", shape.source);
  write_wall(file, shape.wall);
  std::vector<VesicleWriter> writers = writers_of(file, positions.size());
  for (std::size_t a = 0; a < positions.size(); ++a) write_shape(writers[a], positions[a]);
  file.close();
}

void write_sources_input(const std::filesystem::path& path, const Matrix& position, const ElectricParameters& electric,
                         const std::vector<PointSource>& sources) {
  const auto n = static_cast<Index>(sources.size());
  Matrix points(n, 3), strength(n, 1);
  std::vector<std::int64_t> inside;
  for (Index i = 0; i < n; ++i) {
    const PointSource& source = sources[static_cast<std::size_t>(i)];
    points.row(i) = source.position.transpose();
    strength(i, 0) = source.strength;
    inside.push_back(source.inside ? 1 : 0);
  }
  Hdf5Writer whole(path, Hdf5Writer::Mode::create);
  whole.attribute("/", "schema_version", check_schema_version);
  VesicleWriter file(whole, "");
  write_shape(file, position);
  file.group("/physics");
  file.attribute("/physics", "conductivity_in", electric.conductivity_in);
  file.attribute("/physics", "conductivity_out", electric.conductivity_out);
  file.group("/sources");
  write(file, "/sources/position", points, {"length", "point sources"});
  write(file, "/sources/strength", strength, {"potential*length", "s of s/(4 pi r)"});
  file.integers("/sources/inside", inside, {inside.size()}, {"1", "1 inside, 0 outside"});
  whole.close();
}

}  // namespace vehd

#include "fem_check/app/check_input.hpp"

#include <fmt/format.h>

#include "fem_check/app/hdf5_input.hpp"

namespace vehd::fem_check {
namespace {

constexpr double schema_version = 1;

void require_schema(const Hdf5Input& file) {
  const double version = file.number("/", "schema_version");
  if (version != schema_version) {
    file.refuse(fmt::format("has schema version {:g}; accepted: {:g}", version, schema_version));
  }
}

Eigen::MatrixXd matrix_of_size(const Hdf5Input& file, const std::string& dataset, Eigen::Index rows,
                               Eigen::Index columns) {
  Eigen::MatrixXd values = file.matrix(dataset);
  if (values.rows() != rows || values.cols() != columns) {
    file.refuse(fmt::format("dataset {} is {} x {}, but must be {} x {}", dataset, values.cols(), values.rows(),
                            columns, rows));
  }
  return values;
}

Physics read_physics(const Hdf5Input& file) {
  Physics physics;
  physics.field = matrix_of_size(file, "/physics/field", 3, 1);
  physics.viscosity_in = file.number("/physics", "viscosity_in");
  physics.viscosity_out = file.number("/physics", "viscosity_out");
  // Rows of the file are columns here.
  physics.flow_gradient = matrix_of_size(file, "/physics/flow_gradient", 3, 3).transpose();
  if (!file.has("/given/Vm")) return physics;
  physics.conductivity_in = file.number("/physics", "conductivity_in");
  physics.conductivity_out = file.number("/physics", "conductivity_out");
  physics.permittivity_in = file.number("/physics", "permittivity_in");
  physics.permittivity_out = file.number("/physics", "permittivity_out");
  physics.conductance = file.number("/physics", "conductance");
  return physics;
}

BieFields read_fields(const Hdf5Input& file, const std::string& group) {
  const auto field = [&](const std::string& name) { return file.matrix_or_empty(group + "/" + name); };
  return {static_cast<int>(file.number(group, "order")),
          field("q"),
          field("force_electric"),
          field("Vm_steady"),
          field("q_steady"),
          field("velocity"),
          field("velocity_own_force"),
          field("sample_potential"),
          field("sample_velocity")};
}

Samples read_samples(const Hdf5Input& file) {
  Samples samples;
  if (!file.has("/samples")) return samples;
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
  return samples;
}

}  // namespace

CheckInput read_check_input(const std::filesystem::path& path) {
  const Hdf5Input file(path);
  require_schema(file);
  CheckInput input;
  input.source = file.text("/", "source");
  input.time = file.number("/", "time");
  input.position = file.matrix("/x");
  input.physics = read_physics(file);
  input.potential = file.matrix_or_empty("/given/Vm");
  input.force = file.matrix_or_empty("/given/force");
  input.force_electric = file.matrix_or_empty("/given/force_electric");
  input.velocity = file.matrix_or_empty("/given/velocity");
  input.bie = read_fields(file, "/bie");
  input.bie_high = read_fields(file, "/bie_high");
  input.samples = read_samples(file);
  return input;
}

Eigen::MatrixXd read_position(const std::filesystem::path& path) {
  const Hdf5Input file(path);
  require_schema(file);
  return file.matrix("/x");
}

}  // namespace vehd::fem_check

#include "fem_check/app/field_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/vesicle_fields.hpp"
#include "fem_check/app/vtu_file.hpp"

namespace vehd::fem_check {
namespace {

constexpr int surface_intervals = 8;
constexpr int volume_intervals = 4;
/// Smallest relative difference shown in the figure.
constexpr double smallest_shown = 1e-12;

struct BothFields {
  std::string name;
  Eigen::MatrixXd fem, bie;  ///< [components x points]
};

std::vector<BothFields> fields_on_surface(const std::vector<CheckInput>& inputs, const FinestSolutions& finest,
                                          const SurfacePoints& points) {
  std::vector<BothFields> fields;
  const auto add = [&](const std::string& name, Eigen::MatrixXd fem, Eigen::MatrixXd BieFields::*bie) {
    const SurfaceSeries series = series_of(inputs, [bie](const CheckInput& input) { return input.bie.*bie; });
    fields.push_back({name, std::move(fem), series(points)});
  };
  if (finest.potential != nullptr) {
    const PotentialTraces traces = finest.potential->solutions.back().on_surface(points);
    add("q", traces.charge.transpose(), &BieFields::charge);
    if (finest.potential->steady) {
      add("Vm", finest.potential->steady->on_surface(points).transmembrane_potential.transpose(),
          &BieFields::steady_potential);
    }
    add("force", traces.force, &BieFields::force_electric);
  }
  if (finest.flow != nullptr) {
    add("velocity", finest.flow->solutions.back().on_surface(points).velocity, &BieFields::velocity);
  }
  return fields;
}

/// |FEM − BIE| over the largest |BIE|, [points].
Vector relative_difference(const BothFields& field) {
  const double largest = std::max(field.bie.colwise().norm().maxCoeff(), 1e-300);
  return (field.fem - field.bie).colwise().norm().transpose() / largest;
}

void write_differences(const std::filesystem::path& path, const SurfacePoints& points,
                       const std::vector<BothFields>& fields) {
  std::string text = "# x y z";
  std::vector<Vector> columns;
  for (const BothFields& field : fields) {
    text += " " + field.name;
    columns.push_back(relative_difference(field));
  }
  text += "\n";
  constexpr int line = surface_intervals + 1;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    if (i > 0 && i % line == 0) text += i % (line * line) == 0 ? "\n\n" : "\n";
    text += fmt::format("{:.6g} {:.6g} {:.6g}", points.position(0, i), points.position(1, i), points.position(2, i));
    for (const Vector& column : columns)
      text += fmt::format(" {:.4f}", std::log10(std::max(column[i], smallest_shown)));
    text += "\n";
  }
  std::ofstream file(path, std::ios::trunc);
  file << text;
  file.close();
  if (!file) throw InputError(fmt::format("{}: cannot be written", path.string()));
}

void write_surface(const std::filesystem::path& directory, const SurfacePoints& points,
                   const std::vector<BothFields>& fields) {
  std::vector<NamedField> named;
  for (const BothFields& field : fields) {
    named.push_back({field.name + "_fem", field.fem});
    named.push_back({field.name + "_bie", field.bie});
    named.push_back({field.name + "_difference", field.fem - field.bie});
  }
  write_vtu(directory / "surface.vtu", {VtuCells::quadrilaterals, surface_intervals, points.position}, named);
  write_differences(directory / "differences.dat", points, fields);
}

}  // namespace

void write_field_files(const std::filesystem::path& directory, const std::vector<CheckInput>& inputs,
                       const FinestSolutions& finest, const Discretisation& discretisation) {
  const SurfacePoints points = discretisation.lattice_points(surface_intervals);
  write_surface(directory, points, fields_on_surface(inputs, finest, points));

  const VolumePoints volume = discretisation.volume_lattice(volume_intervals);
  Eigen::MatrixXd inside(1, volume.size());
  for (Eigen::Index i = 0; i < volume.size(); ++i) inside(0, i) = volume.inside[i] ? 1.0 : 0.0;
  std::vector<NamedField> fields{{"inside", inside}};
  if (finest.potential != nullptr) {
    fields.push_back({"potential", finest.potential->solutions.back().potential(volume).transpose()});
  }
  if (finest.flow != nullptr) {
    const FlowSolution& flow = finest.flow->solutions.back();
    fields.push_back({"velocity", flow.velocity(volume)});
    fields.push_back({"pressure", flow.pressure(volume).transpose()});
  }
  write_vtu(directory / "volume.vtu", {VtuCells::hexahedra, volume_intervals, volume.position}, fields);
}

}  // namespace vehd::fem_check

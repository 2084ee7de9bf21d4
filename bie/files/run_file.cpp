#include "bie/files/run_file.hpp"

#include <fmt/format.h>

#include "bie/files/versions.hpp"
#include "bie/geometry/surface.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/surface_mesh.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/complex_columns.hpp"

namespace vehd {
namespace {

const DatasetLabel potential_amplitude_label{"potential", "magnitude of the amplitude of V_m in an averaged ac field"};
const DatasetLabel potential_part_label{"potential", "part of the amplitude z of V_m, which is Re(z exp(i omega t))"};
const DatasetLabel phase_label{"1", "phase of V_m against the field in degrees, 0 where there is no V_m"};
const DatasetLabel charge_amplitude_label{"potential/length",
                                          "magnitude of the amplitude of q in an averaged ac field"};
const DatasetLabel charge_part_label{"potential/length", "part of the amplitude z of q, which is Re(z exp(i omega t))"};

/// A label with the SI unit of its dimension.
DatasetLabel labelled(DatasetLabel label, const SiUnits& si_units) {
  const SiUnit unit = si_units(label.dimension);
  label.unit = unit.symbol;
  label.scale = unit.scale;
  return label;
}

/// Extents of a field [n x 3] or [n x 1], whose column-major memory is the row-major data of the file.
std::vector<hsize_t> extents_of(Index components, std::vector<hsize_t> points) {
  if (components > 1) points.insert(points.begin(), static_cast<hsize_t>(components));
  return points;
}

std::span<const double> memory_of(const Matrix& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

void write_coefficient_convention(Hdf5Writer& file, int order) {
  std::vector<std::int64_t> degrees, orders;
  for (int n = 0; n <= order; ++n) {
    for (int m = -n; m <= n; ++m) {
      degrees.push_back(n);
      orders.push_back(m);
    }
  }
  const hsize_t count = degrees.size();
  file.group("/coefficients_convention");
  file.integers("/coefficients_convention/degree", degrees, {count}, {"1", "n of each coefficient"});
  file.integers("/coefficients_convention/order", orders, {count}, {"1", "m of each coefficient"});
  file.text("/coefficients_convention/text",
            "Real orthonormal spherical harmonics on the unit sphere without Condon-Shortley sign: "
            "Y_{n,0} = N P_n^0(cos theta), Y_{n,m} = sqrt(2) N P_n^m(cos theta) cos(m phi), "
            "Y_{n,-m} = sqrt(2) N P_n^m(cos theta) sin(m phi) for m > 0, "
            "N = sqrt((2n+1)/(4 pi) (n-m)!/(n+m)!). Coefficient (n, m) has index n^2 + n + m.");
}

/// One vesicle of a snapshot under construction: each field is written on the grid, as coefficients and on the closed
/// surface.
class VesicleWriter {
 public:
  /// @param group  existing group of the vesicle
  VesicleWriter(Hdf5Writer& file, std::string group, const SphereTransform& transform, const SiUnits& si_units)
      : file_(file), group_(std::move(group)), transform_(transform), si_units_(si_units) {
    file_.group(group_ + "/coefficients");
    file_.group(group_ + "/surface");
  }

  /// Absent effects have no coefficients; nothing is written for them.
  void field(const std::string& name, const Matrix& coefficients, const DatasetLabel& label) {
    if (coefficients.size() == 0) return;
    const Matrix values = transform_.synthesize(coefficients);
    grid_field(name, values, label);
    numbers("coefficients/" + name, coefficients,
            extents_of(coefficients.cols(), {static_cast<hsize_t>(coefficients.rows())}), label);
    // Viewers expect the components of a point together.
    const Matrix surface = with_poles(values, coefficients).transpose();
    std::vector<hsize_t> extents{static_cast<hsize_t>(surface.cols())};
    if (surface.rows() > 1) extents.push_back(static_cast<hsize_t>(surface.rows()));
    numbers("surface/" + name, surface, extents, label);
  }

  /// Writes a field that is computed from columns of coefficients, point by point, and has no coefficients itself.
  template <typename ValuesOf>
  void derived_field(const std::string& name, const Matrix& coefficients, const DatasetLabel& label,
                     const ValuesOf& values_of) {
    const Matrix values = transform_.synthesize(coefficients);
    const Vector all = values_of(with_poles(values, coefficients));
    grid_field(name, all.head(values.rows()), label);
    numbers("surface/" + name, all, {static_cast<hsize_t>(all.size())}, label);
  }

  void grid_field(const std::string& name, const Matrix& values, const DatasetLabel& label) {
    const SphereGrid& grid = transform_.grid();
    numbers(name, values,
            extents_of(values.cols(), {static_cast<hsize_t>(grid.n_theta), static_cast<hsize_t>(grid.n_phi)}), label);
  }

 private:
  void numbers(const std::string& name, const Matrix& values, const std::vector<hsize_t>& extents,
               const DatasetLabel& label) {
    file_.numbers(group_ + "/" + name, memory_of(values), extents, labelled(label, si_units_));
  }

  Hdf5Writer& file_;
  std::string group_;
  const SphereTransform& transform_;
  const SiUnits& si_units_;
};

void write_grid(Hdf5Writer& file, const std::string& group, const SphereGrid& grid) {
  const hsize_t n_theta = static_cast<hsize_t>(grid.n_theta), n_phi = static_cast<hsize_t>(grid.n_phi);
  file.numbers(group + "/theta", memory_of(grid.theta), {n_theta}, {"1", "polar angle from +z", "rad"});
  file.numbers(group + "/phi", memory_of(grid.phi), {n_phi}, {"1", "azimuth", "rad"});
  file.numbers(group + "/weight", memory_of(grid.weight), {n_theta},
               {"1", "Gauss weight times azimuthal spacing: integral of f = sum of f weight area_element"});
}

/// V_m and q of an averaged ac field.
void write_amplitudes(VesicleWriter& writer, const Matrix& potential, const Matrix& charge) {
  if (potential.size() == 0) return;
  writer.derived_field("Vm_amplitude", potential, potential_amplitude_label, magnitudes);
  writer.derived_field("Vm_phase_deg", potential, phase_label, phases_deg);
  writer.field("Vm_real", potential.col(0), potential_part_label);
  writer.field("Vm_imaginary", potential.col(1), potential_part_label);
  writer.derived_field("q_amplitude", charge, charge_amplitude_label, magnitudes);
  writer.field("q_real", charge.col(0), charge_part_label);
  writer.field("q_imaginary", charge.col(1), charge_part_label);
}

void write_vesicle(VesicleWriter& writer, const SphereTransform& transform, SurfaceFields state,
                   const VesicleFields& fields) {
  state.transmembrane_potential = transmembrane_potential(state, fields);
  if (fields.conductance.size() > 0) state.material.conductance = fields.conductance;
  const auto write = [&](const FieldRow& row, const auto& field) {
    if (row.dataset.empty()) return;
    writer.field(std::string(row.dataset), field, {std::string(row.dimension), std::string(row.description)});
  };
  for_each_field(write, state);
  for_each_field(write, fields);
  write_amplitudes(writer, fields.potential_amplitude, fields.charge_amplitude);
  writer.grid_field("area_element", area_element(transform, state.position),
                    {"length^2", "W/sin(theta): area per solid angle of the parameter sphere"});
}

}  // namespace

std::string snapshot_name(std::int64_t number) { return fmt::format("{:06d}", number); }

void write_run_header(Hdf5Writer& file, const SphereTransform& transform, const RunHeader& header) {
  const SphereGrid& grid = transform.grid();
  file.attribute("/", "schema_version", run_schema_version);
  file.attribute("/", "program", "vehd " + program_version());
  file.attribute("/", "order", std::int64_t{transform.order()});
  file.attribute("/", "threads", std::int64_t{header.threads});
  file.attribute(
      "/", "units",
      std::string("numbers are those of the scene; times the scale of a dataset they are in its unit, which is 1 where "
                  "the scene gives no SI unit"));
  for (const auto& [library, version] : library_versions()) file.attribute("/", "version_" + library, version);
  file.text("/scene", header.scene);

  file.group("/grid");
  write_grid(file, "/grid", grid);
  const std::vector<std::int64_t> triangles = closed_triangles(grid);
  file.group("/surface");
  file.integers("/surface/triangles", triangles, {triangles.size() / 3, 3},
                {"1", "closed surface on the grid points (theta-major), north pole, south pole"});
  write_coefficient_convention(file, transform.order());
  file.group("/snapshots");
  const SiUnit time = header.si_units("time");
  file.attribute("/snapshots", "time_unit", time.symbol);
  file.attribute("/snapshots", "time_scale", time.scale);
}

std::string vesicle_group(std::size_t vesicle) { return fmt::format("{:02d}", vesicle); }

std::int64_t write_snapshot(Hdf5Writer& file, const std::string& name, const SphereTransform& transform,
                            const State& state, const Fields& fields, const SiUnits& si_units) {
  const std::string group = "/snapshots/" + name;
  file.group(group);
  file.attribute(group, "time", state.time);
  file.attribute(group, "step", state.step);
  const std::size_t n = state.vesicles.size();
  if (n > 1) file.group(group + "/vesicles");
  for (std::size_t a = 0; a < n; ++a) {
    const std::string own = n > 1 ? group + "/vesicles/" + vesicle_group(a) : group;
    if (n > 1) {
      file.group(own);
      write_grid(file, own, transform.grid());
    }
    const std::int64_t degree = order_of(state.vesicles[a].position.rows());
    file.attribute(own, degree_attribute, degree);
    VesicleWriter writer(file, own, transform, si_units);
    write_vesicle(writer, transform, resized(state.vesicles[a], transform.order()),
                  resized(fields.vesicles[a], transform.order()));
  }
  return file.seal(group);
}

namespace {

std::string attribute_text(const XdmfSeries& series, const std::string& group, const std::string& name,
                           bool is_vector) {
  return fmt::format(
      "        <Attribute Name=\"{0}\" AttributeType=\"{1}\" Center=\"Node\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{2}{3}\">"
      "{4}:/snapshots/{5}/surface/{0}</DataItem>\n"
      "        </Attribute>\n",
      name, is_vector ? "Vector" : "Scalar", series.n_points, is_vector ? " 3" : "", series.heavy_data, group);
}

/// @param group  group of the vesicle in the file
std::string surface_text(const XdmfSeries& series, const std::string& name, const std::string& time,
                         const std::string& group) {
  std::string text = fmt::format(
      "      <Grid Name=\"{0}\" GridType=\"Uniform\">\n"
      "{1}"
      "        <Topology TopologyType=\"Triangle\" NumberOfElements=\"{2}\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"8\" Dimensions=\"{2} 3\">"
      "{3}:/surface/triangles</DataItem>\n"
      "        </Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{4} 3\">"
      "{3}:/snapshots/{5}/surface/x</DataItem>\n"
      "        </Geometry>\n",
      name, time, series.n_triangles, series.heavy_data, series.n_points, group);
  for (const std::string& scalar : series.scalars) text += attribute_text(series, group, scalar, false);
  for (const std::string& vector : series.vectors) text += attribute_text(series, group, vector, true);
  return text + "      </Grid>\n";
}

/// XML text of a square of the wall.
std::string wall_text(const Matrix& corners) {
  std::string numbers;
  for (Index i = 0; i < corners.rows(); ++i) {
    numbers += fmt::format(" {:.9g} {:.9g} {:.9g}", corners(i, 0), corners(i, 1), corners(i, 2));
  }
  return fmt::format(
      "      <Grid Name=\"wall\" GridType=\"Uniform\">\n"
      "        <Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"1\">\n"
      "          <DataItem Format=\"XML\" NumberType=\"Int\" Dimensions=\"1 4\">0 1 2 3</DataItem>\n"
      "        </Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">\n"
      "          <DataItem Format=\"XML\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"4 3\">{}</DataItem>\n"
      "        </Geometry>\n"
      "      </Grid>\n",
      numbers.substr(1));
}

std::string grid_text(const XdmfSeries& series, std::size_t number) {
  const std::string snapshot = snapshot_name(static_cast<std::int64_t>(number));
  const std::string time = fmt::format("        <Time Value=\"{:.17g}\"/>\n", series.times[number]);
  const bool alone = series.n_vesicles == 1, beside_wall = !series.walls.empty();
  if (alone && !beside_wall) return surface_text(series, "vesicle", time, snapshot);
  std::string text = fmt::format("      <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n",
                                 beside_wall ? "vesicles and wall" : "vesicles") +
                     time;
  if (alone) text += surface_text(series, "vesicle", "", snapshot);
  for (std::size_t a = 0; a < series.n_vesicles && !alone; ++a) {
    const std::string own = vesicle_group(a);
    text += surface_text(series, "vesicle " + own, "", snapshot + "/vesicles/" + own);
  }
  if (beside_wall) text += wall_text(series.walls[number]);
  return text + "      </Grid>\n";
}

}  // namespace

std::string xdmf_text(const XdmfSeries& series) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<Xdmf Version=\"2.0\">\n"
      "  <Domain>\n"
      "    <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t number = 0; number < series.times.size(); ++number) text += grid_text(series, number);
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace vehd

#include "bie/files/xdmf.hpp"

#include <fmt/format.h>

#include "bie/files/run_file.hpp"

namespace vehd {
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

/// @param group  of the vesicle in the file
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

std::string grid_text(const XdmfSeries& series, std::size_t number) {
  const std::string snapshot = snapshot_name(static_cast<std::int64_t>(number));
  const std::string time = fmt::format("        <Time Value=\"{:.17g}\"/>\n", series.times[number]);
  if (series.n_vesicles == 1) return surface_text(series, "vesicle", time, snapshot);
  std::string text = "      <Grid Name=\"vesicles\" GridType=\"Collection\" CollectionType=\"Spatial\">\n" + time;
  for (std::size_t a = 0; a < series.n_vesicles; ++a) {
    const std::string own = vesicle_group(a);
    text += surface_text(series, "vesicle " + own, "", snapshot + "/vesicles/" + own);
  }
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

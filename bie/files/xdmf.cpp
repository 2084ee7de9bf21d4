#include "bie/files/xdmf.hpp"

#include <fmt/format.h>

#include "bie/files/run_file.hpp"

namespace vehd {
namespace {

std::string attribute_text(const XdmfSeries& series, const std::string& snapshot, const std::string& name,
                           bool is_vector) {
  return fmt::format(
      "        <Attribute Name=\"{0}\" AttributeType=\"{1}\" Center=\"Node\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{2}{3}\">"
      "{4}:/snapshots/{5}/surface/{0}</DataItem>\n"
      "        </Attribute>\n",
      name, is_vector ? "Vector" : "Scalar", series.n_points, is_vector ? " 3" : "", series.heavy_data, snapshot);
}

std::string grid_text(const XdmfSeries& series, std::size_t number) {
  const std::string snapshot = snapshot_name(static_cast<std::int64_t>(number));
  std::string text = fmt::format(
      "      <Grid Name=\"vesicle\" GridType=\"Uniform\">\n"
      "        <Time Value=\"{0:.17g}\"/>\n"
      "        <Topology TopologyType=\"Triangle\" NumberOfElements=\"{1}\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"8\" Dimensions=\"{1} 3\">"
      "{2}:/surface/triangles</DataItem>\n"
      "        </Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{3} 3\">"
      "{2}:/snapshots/{4}/surface/x</DataItem>\n"
      "        </Geometry>\n",
      series.times[number], series.n_triangles, series.heavy_data, series.n_points, snapshot);
  for (const std::string& name : series.scalars) text += attribute_text(series, snapshot, name, false);
  for (const std::string& name : series.vectors) text += attribute_text(series, snapshot, name, true);
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

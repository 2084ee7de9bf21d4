#include "fem_check/app/vtu_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>

#include "fem_check/app/hdf5_input.hpp"

namespace vehd::fem_check {
namespace {

struct CellKind {
  int dimension;
  std::uint8_t vtk_type;
  std::vector<std::array<int, 3>> corners;  ///< in the order of VTK
};

CellKind kind_of(VtuCells cells) {
  if (cells == VtuCells::quadrilaterals) return {2, 9, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  return {3, 12, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
}

std::vector<std::int64_t> connectivity_of(const Lattices& lattices, const CellKind& kind) {
  const int n = lattices.intervals, line = n + 1;
  const int depth = kind.dimension == 3 ? n : 1;
  const Eigen::Index per_lattice = Eigen::Index{line} * line * (kind.dimension == 3 ? line : 1);
  std::vector<std::int64_t> result;
  for (Eigen::Index first = 0; first < lattices.points.cols(); first += per_lattice) {
    for (int z = 0; z < depth; ++z) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          for (const auto& [dx, dy, dz] : kind.corners) {
            result.push_back(first + (Eigen::Index{z + dz} * line + y + dy) * line + x + dx);
          }
        }
      }
    }
  }
  return result;
}

/// XML header of the file, and the numbers that follow it.
class Appended {
 public:
  template <typename Number>
  void array(const std::string& type, const std::string& name, int components, const Number* numbers,
             std::size_t count) {
    head += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, data.size());
    const std::uint64_t bytes = count * sizeof(Number);
    data.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    data.append(reinterpret_cast<const char*>(numbers), bytes);
  }
  std::string head, data;
};

}  // namespace

void write_vtu(const std::filesystem::path& path, const Lattices& lattices, const std::vector<NamedField>& fields) {
  const CellKind kind = kind_of(lattices.cells);
  const std::vector<std::int64_t> connectivity = connectivity_of(lattices, kind);
  const std::size_t n_cells = connectivity.size() / kind.corners.size();
  std::vector<std::int64_t> offsets;
  for (std::size_t i = 1; i <= n_cells; ++i) offsets.push_back(static_cast<std::int64_t>(i * kind.corners.size()));
  const std::vector<std::uint8_t> types(n_cells, kind.vtk_type);

  Appended out;
  out.head = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n",
      lattices.points.cols(), n_cells);
  for (const NamedField& field : fields) {
    out.array("Float64", field.name, static_cast<int>(field.values.rows()), field.values.data(),
              static_cast<std::size_t>(field.values.size()));
  }
  out.head += "</PointData>\n<Points>\n";
  out.array("Float64", "Points", 3, lattices.points.data(), static_cast<std::size_t>(lattices.points.size()));
  out.head += "</Points>\n<Cells>\n";
  out.array("Int64", "connectivity", 1, connectivity.data(), connectivity.size());
  out.array("Int64", "offsets", 1, offsets.data(), offsets.size());
  out.array("UInt8", "types", 1, types.data(), types.size());
  out.head += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << out.head << out.data << "\n</AppendedData>\n</VTKFile>\n";
  file.close();
  if (!file) throw InputError(fmt::format("{}: cannot be written", path.string()));
}

}  // namespace vehd::fem_check

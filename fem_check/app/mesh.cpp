#include "fem_check/app/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fem_check/app/check_input.hpp"
#include "meshes/msh_file.hpp"
#include "meshes/second_order_mesh.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::fem_check {
namespace {

constexpr double outer_radius = 8.0;  ///< over the radius of the shape
constexpr double refinement_step = 1.5;

/// A number of cells when each is divided by `factor`.
int refined(int cells, double factor) { return std::max(cells, static_cast<int>(std::lround(cells * factor))); }

/// With the quality of what the file holds, which is not the exact map of hexahedra.
MeshResult written(const MeshTask& task, const meshes::FrozenShape& shape, const meshes::VolumeMesh& mesh,
                   double smallest_scaled_jacobian) {
  MeshResult result;
  result.family = task.family;
  result.n_cells = mesh.n_cells();
  result.n_faces = static_cast<int>(mesh.interface().size());
  result.outer_radius = mesh.outer_radius();
  result.shape_volume = shape.volume();
  result.shape_area = shape.area();
  result.quality = quality(mesh, shape);
  require_quality(result.quality, smallest_scaled_jacobian);
  meshes::write_msh(task.output, mesh, result.quality);
  return result;
}

}  // namespace

MeshResult run_mesh(const MeshTask& task) {
  const meshes::FrozenShape shape(read_position(task.input));
  const double factor = std::pow(refinement_step, task.refine);
  if (task.family == "tet") {
    meshes::TetMeshOptions options;
    options.surface_size /= factor;
    options.largest_size /= factor;
    options.growth /= factor;
    options.outer_radius = outer_radius * shape.radius();
    return written(task, shape, meshes::make_tetrahedral_mesh(shape, options), options.smallest_scaled_jacobian);
  }
  meshes::BlockMeshOptions options;
  options.cells_per_edge = refined(options.cells_per_edge, factor);
  options.blend_layers = refined(options.blend_layers, factor);
  options.shell_layers = refined(options.shell_layers, factor);
  options.outer_radius = outer_radius * shape.radius();
  const meshes::HexMesh exact = meshes::make_block_mesh(shape, options);
  return written(task, shape, meshes::SecondOrderMesh(exact), options.smallest_scaled_jacobian);
}

std::string text_of(const MeshResult& result) {
  const meshes::MeshQuality& q = result.quality;
  return fmt::format(
      "{} {}, {} faces on the membrane, out to radius {:.4g}\n"
      "smallest scaled Jacobian {:.3f} at ({:.3g}, {:.3g}, {:.3g}) {} the membrane; sizes {:.3g} to {:.3g}\n"
      "volume inside {:.10g}, of the shape {:.10g}: {:+.1e}\n"
      "area of the membrane {:.10g}, of the shape {:.10g}: {:+.1e}\n",
      result.n_cells, result.family == "tet" ? "tetrahedra" : "hexahedra", result.n_faces, result.outer_radius,
      q.smallest_scaled_jacobian, q.worst_position.x(), q.worst_position.y(), q.worst_position.z(),
      q.worst_region == meshes::Region::inside ? "inside" : "outside", q.smallest_size, q.largest_size, q.volume_inside,
      result.shape_volume, q.volume_error, q.area, result.shape_area, q.area_error);
}

nlohmann::json json_of(const MeshResult& result) {
  const meshes::MeshQuality& q = result.quality;
  return {{"family", result.family},
          {"cells", result.n_cells},
          {"membrane_faces", result.n_faces},
          {"outer_radius", result.outer_radius},
          {"smallest_scaled_jacobian", q.smallest_scaled_jacobian},
          {"worst_position", {q.worst_position.x(), q.worst_position.y(), q.worst_position.z()}},
          {"volume", q.volume_inside},
          {"volume_error", q.volume_error},
          {"area", q.area},
          {"area_error", q.area_error}};
}

}  // namespace vehd::fem_check

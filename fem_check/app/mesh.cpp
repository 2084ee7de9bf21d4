#include "fem_check/app/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/refinement.hpp"
#include "meshes/msh_file.hpp"
#include "meshes/second_order_mesh.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::fem_check {
namespace {

constexpr double outer_radius = 8.0;  ///< over the radius of the shape
constexpr double refinement_step = 1.5;

/// Number of cells after dividing each by `factor`.
int refined(int cells, double factor) { return std::max(cells, static_cast<int>(std::lround(cells * factor))); }

/// Writes a mesh; checks the quality of the mesh in the file, which differs from the exact map of hexahedra.
MeshResult written(const MeshTask& task, const std::vector<meshes::FrozenShape>& shapes, const meshes::VolumeMesh& mesh,
                   double smallest_scaled_jacobian) {
  MeshResult result;
  result.family = task.family;
  result.n_cells = mesh.n_cells();
  result.n_faces = static_cast<int>(mesh.interface().size());
  result.outer_radius = mesh.outer_radius();
  for (const meshes::FrozenShape& shape : shapes) {
    result.shape_volumes.push_back(shape.volume());
    result.shape_areas.push_back(shape.area());
  }
  result.quality = quality(mesh, shapes);
  require_quality(result.quality, smallest_scaled_jacobian);
  meshes::write_msh(task.output, mesh, result.quality);
  return result;
}

/// Layers of a mesh for other programs, in which the geometry is quadratic.
void refine(meshes::BoxMeshOptions& options, double factor) {
  const meshes::BlockMeshOptions of_one;
  options.cells_per_edge = refined(of_one.cells_per_edge, factor);
  options.blend_layers = refined(of_one.blend_layers, factor);
  options.box_layers = refined(options.box_layers, factor);
  options.outer_layers = refined(options.outer_layers, factor);
}

MeshResult mesh_beside_wall(const MeshTask& task, const meshes::FrozenShape& shape, const meshes::Wall& wall,
                            double factor) {
  if (task.family == "tet") throw InputError("--family tet: does not mesh a wall; accepted beside one: hex");
  meshes::BoxMeshOptions options = wall_mesh_options({}, shape, wall);
  refine(options, factor);
  const meshes::BoxMesh exact = meshes::make_mesh_beside_wall(shape, wall, options);
  return written(task, {shape}, meshes::SecondOrderMesh(exact), options.smallest_scaled_jacobian);
}

MeshResult mesh_of_two(const MeshTask& task, const std::vector<meshes::FrozenShape>& shapes, double factor) {
  if (task.family == "tet") throw InputError("--family tet: meshes one vesicle; accepted for two: hex");
  const std::array pair{shapes[0], shapes[1]};
  meshes::BoxMeshOptions options = two_vesicle_options({}, pair);
  refine(options, factor);
  const meshes::BoxMesh exact = meshes::make_two_vesicle_mesh(pair, options);
  return written(task, shapes, meshes::SecondOrderMesh(exact), options.smallest_scaled_jacobian);
}

}  // namespace

MeshResult run_mesh(const MeshTask& task) {
  const InputShapes input = read_shapes(task.input);
  std::vector<meshes::FrozenShape> shapes;
  for (const Eigen::MatrixXd& position : input.positions) shapes.emplace_back(position);
  const double factor = std::pow(refinement_step, task.refine);
  if (shapes.size() > 2) throw InputError(fmt::format("{}: has {} vesicles", task.input.string(), shapes.size()));
  if (shapes.size() == 2) return mesh_of_two(task, shapes, factor);
  const meshes::FrozenShape& shape = shapes.front();
  if (input.wall) return mesh_beside_wall(task, shape, *input.wall, factor);
  if (task.family == "tet") {
    meshes::TetMeshOptions options;
    options.surface_size /= factor;
    options.largest_size /= factor;
    options.growth /= factor;
    options.outer_radius = outer_radius * shape.radius();
    return written(task, shapes, meshes::make_tetrahedral_mesh(shape, options), options.smallest_scaled_jacobian);
  }
  meshes::BlockMeshOptions options;
  options.cells_per_edge = refined(options.cells_per_edge, factor);
  options.blend_layers = refined(options.blend_layers, factor);
  options.shell_layers = refined(options.shell_layers, factor);
  options.outer_radius = outer_radius * shape.radius();
  const meshes::HexMesh exact = meshes::make_block_mesh(shape, options);
  return written(task, shapes, meshes::SecondOrderMesh(exact), options.smallest_scaled_jacobian);
}

std::string text_of(const MeshResult& result) {
  const meshes::MeshQuality& q = result.quality;
  std::string text = fmt::format(
      "{} {}, {} faces on the membrane{}, out to radius {:.4g}\n"
      "smallest scaled Jacobian {:.3f} at ({:.3g}, {:.3g}, {:.3g}) {} the membrane; sizes {:.3g} to {:.3g}\n",
      result.n_cells, result.family == "tet" ? "tetrahedra" : "hexahedra", result.n_faces,
      q.vesicles.size() > 1 ? "s" : "", result.outer_radius, q.smallest_scaled_jacobian, q.worst_position.x(),
      q.worst_position.y(), q.worst_position.z(), q.worst_region == meshes::Region::inside ? "inside" : "outside",
      q.smallest_size, q.largest_size);
  for (std::size_t k = 0; k < q.vesicles.size(); ++k) {
    const meshes::VesicleMeasures& vesicle = q.vesicles[k];
    text += fmt::format(
        "volume inside {:.10g}, of the shape {:.10g}: {:+.1e}\n"
        "area of the membrane {:.10g}, of the shape {:.10g}: {:+.1e}\n",
        vesicle.volume, result.shape_volumes[k], vesicle.volume_error, vesicle.area, result.shape_areas[k],
        vesicle.area_error);
  }
  return text;
}

nlohmann::json json_of(const MeshResult& result) {
  const meshes::MeshQuality& q = result.quality;
  nlohmann::json json{{"family", result.family},
                      {"cells", result.n_cells},
                      {"membrane_faces", result.n_faces},
                      {"outer_radius", result.outer_radius},
                      {"smallest_scaled_jacobian", q.smallest_scaled_jacobian},
                      {"worst_position", {q.worst_position.x(), q.worst_position.y(), q.worst_position.z()}},
                      {"volume", q.volume_inside},
                      {"volume_error", q.volume_error},
                      {"area", q.area},
                      {"area_error", q.area_error}};
  if (q.vesicles.size() == 1) return json;
  for (const meshes::VesicleMeasures& vesicle : q.vesicles) {
    json["vesicles"].push_back({{"volume", vesicle.volume},
                                {"volume_error", vesicle.volume_error},
                                {"area", vesicle.area},
                                {"area_error", vesicle.area_error}});
  }
  return json;
}

}  // namespace vehd::fem_check

#include "fem_check/space.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "fem_check/cell_kernel.hpp"
#include "fem_check/cell_points.hpp"
#include "fem_check/membrane_trace.hpp"

namespace vehd::fem_check {

namespace {

using meshes::CellShape;
using meshes::FaceKind;

UnitPoint unit_vertex(int vertex) { return {double(vertex & 1), double(vertex >> 1 & 1), double(vertex >> 2 & 1)}; }

/// Number of the vertex of deal.II's cell that is each vertex of the mesh's cell.
std::array<int, 8> inverse(const std::array<int, 8>& mesh_vertex) {
  std::array<int, 8> result{};
  for (int v = 0; v < 8; ++v) result[mesh_vertex[v]] = v;
  return result;
}

/// Face of the unit cell that contains the four corners.
unsigned face_of(const std::array<UnitPoint, 4>& corners) {
  for (unsigned d = 0; d < 3; ++d) {
    const double first = corners[0][d];
    if (std::all_of(corners.begin(), corners.end(), [&](const UnitPoint& c) { return c[d] == first; })) {
      return 2 * d + (first > 0.5 ? 1 : 0);
    }
  }
  throw std::logic_error("four vertices that do not form a face of the cell");
}

void create_triangulation(Space& space) {
  const meshes::VolumeMesh& mesh = *space.mesh;
  std::vector<dealii::Point<3>> vertices;
  for (const meshes::Point& place : mesh.vertex_positions()) {
    const Vector3 x = space.dimensionless(place);
    vertices.emplace_back(x.x(), x.y(), x.z());
  }
  std::vector<dealii::CellData<3>> cells(mesh.n_cells());
  for (int c = 0; c < mesh.n_cells(); ++c) {
    std::copy_n(mesh.cell(c).vertices.begin(), 8, cells[c].vertices.begin());
    cells[c].material_id = static_cast<dealii::types::material_id>(mesh.cell(c).region);
  }
  // deal.II rotates cells until the directions of all edges agree; the new place of each vertex is stored.
  dealii::GridTools::consistently_order_cells(cells);
  space.mesh_vertex.resize(cells.size());
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto& old = mesh.cell(c).vertices;
    for (int v = 0; v < 8; ++v) {
      const auto place = std::find(old.begin(), old.end(), static_cast<int>(cells[c].vertices[v]));
      space.mesh_vertex[c][v] = static_cast<int>(place - old.begin());
    }
  }
  space.triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
}

void fill_mapping(Space& space) {
  const auto units = dealii::FE_Q<3>(space.mapping.get_degree()).get_unit_support_points();
  space.boxes.reserve(space.triangulation.n_active_cells());
  std::vector<std::vector<dealii::Point<3>>> positions(space.triangulation.n_active_cells());
  for (unsigned c = 0; c < positions.size(); ++c) {
    std::vector<meshes::Point> mesh_units;
    for (const UnitPoint& unit : units) mesh_units.push_back(space.mesh_unit(c, unit));
    for (const meshes::Point& place : space.mesh->physical_points(static_cast<int>(c), mesh_units)) {
      const Vector3 x = space.dimensionless(place);
      positions[c].emplace_back(x.x(), x.y(), x.z());
    }
    space.boxes.emplace_back(positions[c]);
    Vectors& nodes = space.mapping_nodes.emplace_back(3, static_cast<Eigen::Index>(positions[c].size()));
    for (std::size_t i = 0; i < positions[c].size(); ++i) {
      for (unsigned d = 0; d < 3; ++d) nodes(d, static_cast<Eigen::Index>(i)) = positions[c][i][d];
    }
  }
  space.mapping.initialize(space.triangulation, [&](const auto& cell) { return positions[cell->index()]; });
}

void find_faces(Space& space) {
  for (const meshes::InterfacePair& pair : space.mesh->interface()) {
    MembraneFace face{space.mesh->cell(pair.inside_cell).vesicle,
                      static_cast<unsigned>(pair.inside_cell),
                      static_cast<unsigned>(pair.outside_cell),
                      {},
                      {}};
    const auto inner = inverse(space.mesh_vertex[face.inner_cell]);
    const auto outer = inverse(space.mesh_vertex[face.outer_cell]);
    const auto& inner_vertices = meshes::face_vertices(CellShape::hexahedron, pair.inside_face);
    for (int k = 0; k < 4; ++k) {
      face.inner_corners[k] = unit_vertex(inner[inner_vertices[k]]);
      face.outer_corners[k] = unit_vertex(outer[pair.outside_vertex[k]]);
    }
    space.membrane.push_back(face);
  }
  for (int c = 0; c < space.mesh->n_cells(); ++c) {
    const auto inner = inverse(space.mesh_vertex[c]);
    for (int f = 0; f < 6; ++f) {
      const FaceKind kind = space.mesh->cell(c).faces[f];
      if (kind != FaceKind::outer_sphere && kind != FaceKind::wall) continue;
      std::array<UnitPoint, 4> corners;
      const auto& vertices = meshes::face_vertices(CellShape::hexahedron, f);
      for (int k = 0; k < 4; ++k) corners[k] = unit_vertex(inner[vertices[k]]);
      (kind == FaceKind::wall ? space.wall : space.outer).push_back({static_cast<unsigned>(c), face_of(corners)});
    }
  }
}

void require_supported(const meshes::VolumeMesh& mesh, int degree) {
  if (mesh.cell_shape() != CellShape::hexahedron) {
    throw std::invalid_argument("the mesh has tetrahedra; the solvers take hexahedra");
  }
  if (degree < 1 || degree > highest_degree) {
    throw std::invalid_argument("element degree is " + std::to_string(degree) + "; accepted are 1 to " +
                                std::to_string(highest_degree));
  }
  for (const auto& [inside, outside] : mesh.topology().interface_vertices) {
    if (inside == outside) throw std::invalid_argument("inside and outside share vertices; split the interface");
  }
}

}  // namespace

Space::Space(std::shared_ptr<const meshes::VolumeMesh> volume_mesh, int degree, MPI_Comm ranks, int points_per_edge)
    : mesh(std::move(volume_mesh)),
      centre(mesh->centre()),
      length(mesh->outer_radius()),
      communicator(ranks),
      triangulation(communicator, dealii::Triangulation<3>::none, false,
                    dealii::parallel::shared::Triangulation<3>::partition_metis),
      mapping(static_cast<unsigned>(degree + 1)),
      element(static_cast<unsigned>(degree)),
      n_vesicles(mesh->n_vesicles()) {
  require_supported(*mesh, degree);
  create_triangulation(*this);
  fill_mapping(*this);
  find_faces(*this);
  dofs.reinit(triangulation);
  dofs.distribute_dofs(element);
  trace = std::make_shared<MembraneTrace>(*this, std::max(degree + 2, points_per_edge));
}

meshes::Point Space::mesh_unit(unsigned cell, const UnitPoint& unit) const {
  meshes::Point result = meshes::Point::Zero();
  const auto weights = meshes::vertex_functions(CellShape::hexahedron, meshes::Point(unit[0], unit[1], unit[2]));
  for (int v = 0; v < 8; ++v) {
    result += weights[v] * meshes::unit_vertex(CellShape::hexahedron, mesh_vertex[cell][v]);
  }
  return result;
}

UnitPoint on_face(const std::array<UnitPoint, 4>& corners, double s, double t) {
  UnitPoint result;
  for (unsigned d = 0; d < 3; ++d) {
    result[d] = (1 - s) * (1 - t) * corners[0][d] + s * (1 - t) * corners[1][d] + (1 - s) * t * corners[2][d] +
                s * t * corners[3][d];
  }
  return result;
}

SheetPairs sheet_pairs(const Space& space, const dealii::DoFHandler<3>& handler) {
  const auto& element = handler.get_fe();
  const auto& nodes = element.get_unit_support_points();
  const auto node_at = [&](const UnitPoint& unit) -> int {
    for (unsigned i = 0; i < nodes.size(); ++i) {
      if (nodes[i].distance(unit) < 1e-9) return static_cast<int>(i);
    }
    throw std::logic_error("no node where the other side of the membrane has one");
  };
  const std::vector<double> line = edge_nodes(element.degree);
  SheetPairs result;
  result.index_of_inner.assign(handler.n_dofs(), -1);
  std::vector<DofIndex> inner(nodes.size());
  std::vector<DofIndex> outer(nodes.size());
  for (const MembraneFace& face : space.membrane) {
    space.cell(handler, face.inner_cell)->get_dof_indices(inner);
    space.cell(handler, face.outer_cell)->get_dof_indices(outer);
    std::vector<int>& of_face = result.of_face.emplace_back();
    for (const double t : line) {
      for (const double s : line) {
        const DofIndex i = inner[node_at(on_face(face.inner_corners, s, t))];
        const DofIndex e = outer[node_at(on_face(face.outer_corners, s, t))];
        if (result.index_of_inner[i] < 0) {
          result.index_of_inner[i] = static_cast<int>(result.pairs.size());
          result.pairs.push_back({i, e});
          result.vesicle.push_back(face.vesicle);
        }
        of_face.push_back(result.index_of_inner[i]);
      }
    }
  }
  return result;
}

std::vector<FaceRun> face_runs(const SurfacePoints& points) {
  std::vector<FaceRun> runs;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    if (runs.empty() || runs.back().face != points.face[i]) runs.push_back({points.face[i], i, 0});
    ++runs.back().size;
  }
  return runs;
}

std::vector<CellRun> cell_runs(const VolumePoints& points) {
  std::vector<CellRun> runs;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const auto cell = static_cast<unsigned>(points.cell[i]);
    if (runs.empty() || runs.back().cell != cell) runs.push_back({cell, i, 0, {}});
    ++runs.back().size;
    runs.back().units.emplace_back(points.unit(0, i), points.unit(1, i), points.unit(2, i));
  }
  return runs;
}

std::vector<UnitPoint> unit_points(const Space& space, const SurfacePoints& points, const FaceRun& run, Side side) {
  const MembraneFace& face = space.membrane[run.face];
  const auto& corners = side == Side::inside ? face.inner_corners : face.outer_corners;
  std::vector<UnitPoint> units;
  for (Eigen::Index i = run.begin; i < run.begin + run.size; ++i) {
    units.push_back(on_face(corners, points.face_coordinates(0, i), points.face_coordinates(1, i)));
  }
  return units;
}

namespace {

/// Computes position, normal, direction, and weights times the area element, from the face coordinates.
void fill_geometry(const Space& space, SurfacePoints& points) {
  const Eigen::Index n = static_cast<Eigen::Index>(points.face.size());
  points.position.resize(3, n);
  points.normal.resize(3, n);
  points.direction.resize(3, n);
  CellPoints cell(space, space.dofs);
  for (const FaceRun& run : face_runs(points)) {
    const MembraneFace& face = space.membrane[run.face];
    const auto units = unit_points(space, points, run, Side::inside);
    cell.reinit(face.inner_cell, units);
    points.position.middleCols(run.begin, run.size) = cell.positions();
    const auto axis = [&](int k) {
      const UnitPoint& a = face.inner_corners[0];
      const UnitPoint& b = face.inner_corners[k];
      return Vector3(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    };
    // The normal points away from the middle of the inner cell.
    const UnitPoint centre = on_face(face.inner_corners, 0.5, 0.5);
    const Vector3 outward = Vector3(centre[0], centre[1], centre[2]) - Vector3::Constant(0.5);
    const double sign = axis(1).cross(axis(2)).dot(outward) > 0.0 ? 1.0 : -1.0;
    for (Eigen::Index i = 0; i < run.size; ++i) {
      const Matrix3 jacobian = cell.jacobian(i);
      const Vector3 area = sign * (jacobian * axis(1)).cross(jacobian * axis(2));
      points.normal.col(run.begin + i) = area.normalized();
      points.direction.col(run.begin + i) =
          space.mesh->direction(static_cast<int>(face.inner_cell), space.mesh_unit(face.inner_cell, units[i]));
      points.weight[run.begin + i] *= area.norm();
    }
  }
}

}  // namespace

SurfacePoints tensor_points(const Space& space, const std::vector<double>& nodes, const std::vector<double>& weights) {
  SurfacePoints points;
  const std::size_t per_face = nodes.size() * nodes.size();
  const auto n = static_cast<Eigen::Index>(space.membrane.size() * per_face);
  points.face.reserve(n);
  points.face_coordinates.resize(2, n);
  points.weight.resize(n);
  Eigen::Index i = 0;
  for (std::size_t f = 0; f < space.membrane.size(); ++f) {
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      for (std::size_t a = 0; a < nodes.size(); ++a, ++i) {
        points.face.push_back(static_cast<int>(f));
        points.vesicle.push_back(space.membrane[f].vesicle);
        points.face_coordinates.col(i) << nodes[a], nodes[b];
        points.weight[i] = weights.empty() ? 0.0 : weights[a] * weights[b];
      }
    }
  }
  fill_geometry(space, points);
  return points;
}

std::vector<double> edge_nodes(unsigned degree) {
  std::vector<double> nodes;
  const dealii::QGaussLobatto<1> lobatto(degree + 1);
  for (const auto& point : lobatto.get_points()) nodes.push_back(point[0]);
  return nodes;
}

std::vector<dealii::Polynomials::Polynomial<double>> edge_polynomials(unsigned degree) {
  return dealii::Polynomials::generate_complete_Lagrange_basis(dealii::QGaussLobatto<1>(degree + 1).get_points());
}

std::size_t peak_memory_bytes() {
  dealii::Utilities::System::MemoryStats stats;
  dealii::Utilities::System::get_memory_stats(stats);
  return std::size_t(stats.VmHWM) * 1024;
}

}  // namespace vehd::fem_check

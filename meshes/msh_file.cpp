#include "meshes/msh_file.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "meshes/gmsh_session.hpp"

namespace vehd::meshes {
namespace {

using VertexList = std::vector<int>;

/// gmsh's second-order nodes in gmsh's order: each is the middle of the listed vertices (deal.II's numbers) of the unit
/// cell.
const std::vector<VertexList>& second_order_nodes(CellShape shape) {
  static const std::vector<VertexList> kHexahedron{{0},          {1},          {3},
                                                   {2},          {4},          {5},
                                                   {7},          {6},          {0, 1},
                                                   {0, 2},       {0, 4},       {1, 3},
                                                   {1, 5},       {3, 2},       {3, 7},
                                                   {2, 6},       {4, 5},       {4, 6},
                                                   {5, 7},       {7, 6},       {0, 1, 2, 3},
                                                   {0, 1, 4, 5}, {0, 2, 4, 6}, {1, 3, 5, 7},
                                                   {2, 3, 6, 7}, {4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}};
  static const std::vector<VertexList> kTetrahedron{{0}, {1}, {2}, {3}, {0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}};
  return shape == CellShape::hexahedron ? kHexahedron : kTetrahedron;
}

/// Elements of one region, and the nodes that they use first.
struct RegionElements {
  std::vector<std::size_t> element_tags;
  std::vector<std::size_t> element_nodes;
  std::vector<std::size_t> node_tags;
  std::vector<double> node_positions;
};

/// Nodes are identified by sets of vertices: cells share the nodes of a common face, and a split interface stays split.
class NodeNumbers {
 public:
  /// Tag of the node of these vertices, from 1; `fresh` is set if it is new.
  std::size_t tag(VertexList vertices, bool& fresh) {
    std::sort(vertices.begin(), vertices.end());
    const auto [place, inserted] = tags_.try_emplace(std::move(vertices), tags_.size() + 1);
    fresh = inserted;
    return place->second;
  }

 private:
  std::map<VertexList, std::size_t> tags_;
};

void add_element(const VolumeMesh& mesh, int cell, NodeNumbers& numbers, RegionElements& elements) {
  elements.element_tags.push_back(cell + 1);
  for (const VertexList& corners : second_order_nodes(mesh.cell_shape())) {
    VertexList vertices;
    Point unit = Point::Zero();
    for (const int v : corners) {
      vertices.push_back(mesh.cell(cell).vertices[v]);
      unit += unit_vertex(mesh.cell_shape(), v) / double(corners.size());
    }
    bool fresh = false;
    elements.element_nodes.push_back(numbers.tag(std::move(vertices), fresh));
    if (!fresh) continue;
    elements.node_tags.push_back(elements.element_nodes.back());
    const Point x = mesh.physical(cell, unit);
    elements.node_positions.insert(elements.node_positions.end(), x.begin(), x.end());
  }
}

void add_region(int volume, const std::string& name, CellShape shape, const RegionElements& elements) {
  constexpr int kHexahedron27 = 12;  // gmsh's element types
  constexpr int kTetrahedron10 = 11;
  gmsh::model::addDiscreteEntity(3, volume);
  gmsh::model::mesh::addNodes(3, volume, elements.node_tags, elements.node_positions);
  gmsh::model::mesh::addElementsByType(volume, shape == CellShape::hexahedron ? kHexahedron27 : kTetrahedron10,
                                       elements.element_tags, elements.element_nodes);
  gmsh::model::addPhysicalGroup(3, {volume}, volume);
  gmsh::model::setPhysicalName(3, volume, name);
}

/// Adds the faces of one membrane as separate elements on the nodes of the cells of one region.
void add_membrane(int surface, const std::string& name, const VolumeMesh& mesh, Region region, int vesicle,
                  NodeNumbers& numbers, std::size_t& last_tag) {
  constexpr int kQuadrangle9 = 10;  // gmsh's element types
  constexpr int kTriangle6 = 9;
  const bool is_hexahedron = mesh.cell_shape() == CellShape::hexahedron;
  std::vector<std::size_t> tags, nodes;
  for (const InterfacePair& pair : mesh.interface()) {
    if (mesh.cell(pair.inside_cell).vesicle != vesicle) continue;
    const int cell = region == Region::inside ? pair.inside_cell : pair.outside_cell;
    const std::array<int, 4>& inner = face_vertices(mesh.cell_shape(), pair.inside_face);
    // Corners in cyclic order, with the normal outwards; deal.II numbers a quadrilateral lexicographically.
    std::vector<int> corners;
    for (const int k : is_hexahedron ? VertexList{0, 1, 3, 2} : VertexList{0, 1, 2}) {
      corners.push_back(mesh.cell(cell).vertices[region == Region::inside ? inner[k] : pair.outside_vertex[k]]);
    }
    const bool is_outwards = is_hexahedron && pair.inside_face % 2 == 1;
    if (!is_outwards) std::reverse(corners.begin(), corners.end());
    std::vector<VertexList> sets;
    for (const int corner : corners) sets.push_back({corner});
    for (std::size_t k = 0; k < corners.size(); ++k) sets.push_back({corners[k], corners[(k + 1) % corners.size()]});
    if (is_hexahedron) sets.push_back(corners);
    bool fresh = false;
    for (VertexList& set : sets) nodes.push_back(numbers.tag(std::move(set), fresh));
    tags.push_back(++last_tag);
  }
  gmsh::model::addDiscreteEntity(2, surface);
  gmsh::model::mesh::addElementsByType(surface, is_hexahedron ? kQuadrangle9 : kTriangle6, tags, nodes);
  gmsh::model::addPhysicalGroup(2, {surface}, surface);
  gmsh::model::setPhysicalName(2, surface, name);
}

int add_quality_view(const MeshQuality& quality) {
  std::string model;
  gmsh::model::getCurrent(model);
  std::vector<std::size_t> tags;
  std::vector<std::vector<double>> values;
  for (std::size_t c = 0; c < quality.scaled_jacobian.size(); ++c) {
    tags.push_back(c + 1);
    values.push_back({quality.scaled_jacobian[c]});
  }
  const int view = gmsh::view::add("smallest scaled Jacobian");
  gmsh::view::addModelData(view, 0, model, "ElementData", tags, values);
  return view;
}

}  // namespace

void write_msh(const std::filesystem::path& file, const VolumeMesh& mesh, const MeshQuality& quality) {
  // gmsh itself reports an unwritable file late and with little detail.
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder)) {
    throw MeshError(fmt::format("cannot write {}: there is no folder {}", file.string(), folder.string()));
  }
  NodeNumbers numbers;
  const int n_vesicles = mesh.n_vesicles();
  std::vector<RegionElements> inside(n_vesicles);
  RegionElements outside;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const MeshCell& cell = mesh.cell(c);
    add_element(mesh, c, numbers, cell.region == Region::inside ? inside[cell.vesicle] : outside);
  }
  const auto of_vesicle = [&](const std::string& name, int vesicle) {
    return n_vesicles == 1 ? name : fmt::format("{}_{}", name, vesicle);
  };
  const GmshSession session;
  try {
    for (int k = 0; k < n_vesicles; ++k) add_region(k + 1, of_vesicle("inside", k), mesh.cell_shape(), inside[k]);
    add_region(n_vesicles + 1, "outside", mesh.cell_shape(), outside);
    auto last_tag = static_cast<std::size_t>(mesh.n_cells());
    for (int k = 0; k < n_vesicles; ++k) {
      add_membrane(2 * k + 1, of_vesicle("membrane", k), mesh, Region::inside, k, numbers, last_tag);
      add_membrane(2 * k + 2, of_vesicle("membrane_outside", k), mesh, Region::outside, k, numbers, last_tag);
    }
    const int view = add_quality_view(quality);
    gmsh::write(file.string());
    // By default a view stores its own copy of the mesh, which would duplicate every element.
    gmsh::option::setNumber("PostProcessing.SaveMesh", 0);
    constexpr bool kAppend = true;
    gmsh::view::write(view, file.string(), kAppend);
  } catch (...) {
    throw MeshError(fmt::format("cannot write {}: {}", file.string(), gmsh_message()));
  }
}

}  // namespace vehd::meshes

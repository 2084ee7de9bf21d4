#pragma once

#include <algorithm>
#include <memory>

#include "fem_check/deal_ii.hpp"
#include "fem_check/types.hpp"
#include "meshes/volume_mesh.hpp"

/// Internals of Discretisation, for the sources of this folder.
namespace vehd::fem_check {

/// Number of a degree of freedom.
using DofIndex = dealii::types::global_dof_index;
/// A point of the unit cell, in deal.II's numbering.
using UnitPoint = dealii::Point<3>;

/// One face of γ from both sides. Corner k has face coordinates (k & 1, k >> 1) and coincides on the two sides.
struct MembraneFace {
  int vesicle;
  unsigned inner_cell;
  unsigned outer_cell;
  std::array<UnitPoint, 4> inner_corners;
  std::array<UnitPoint, 4> outer_corners;
};

/// A face on the outer sphere or on the wall.
struct OuterFace {
  unsigned cell;
  unsigned face;
};

class MembraneTrace;

/// Triangulation, curved mapping and one scalar element. deal.II uses dimensionless coordinates: positions relative to
/// the centre of the outer sphere over its radius.
struct Space {
  /// @param points_per_edge  as in Discretisation
  Space(std::shared_ptr<const meshes::VolumeMesh> mesh, int degree, MPI_Comm communicator, int points_per_edge);

  using Cell = dealii::DoFHandler<3>::active_cell_iterator;
  [[nodiscard]] Cell cell(const dealii::DoFHandler<3>& handler, unsigned index) const {
    return {&triangulation, 0, static_cast<int>(index), &handler};
  }
  [[nodiscard]] Cell cell(unsigned index) const { return cell(dofs, index); }
  [[nodiscard]] bool inside(unsigned index) const { return mesh->cell(index).region == meshes::Region::inside; }
  /// Vesicle that contains a cell; outside, the vesicle whose blocks it belongs to.
  [[nodiscard]] int vesicle(unsigned index) const { return mesh->cell(index).vesicle; }
  /// Dimensionless position of a point in the user's units, and the inverse.
  [[nodiscard]] Vector3 dimensionless(const Vector3& x) const { return (x - centre) / length; }
  [[nodiscard]] Vector3 physical(const Vector3& x) const { return centre + length * x; }
  /// Unit coordinates in the numbering of the mesh; deal.II can rotate its cells.
  [[nodiscard]] meshes::Point mesh_unit(unsigned cell, const UnitPoint& unit) const;

  std::shared_ptr<const meshes::VolumeMesh> mesh;
  Vector3 centre;
  double length;  ///< unit of length, R
  MPI_Comm communicator;
  dealii::parallel::shared::Triangulation<3> triangulation;
  dealii::MappingQCache<3> mapping;
  dealii::FE_Q<3> element;
  dealii::DoFHandler<3> dofs;
  std::vector<std::array<int, 8>> mesh_vertex;  ///< vertex number in the mesh's cell for each vertex of deal.II's cell
  int n_vesicles;
  std::vector<MembraneFace> membrane;
  std::vector<OuterFace> outer;
  std::vector<OuterFace> wall;
  std::vector<Vectors> mapping_nodes;         ///< of every cell, in deal.II's order, dimensionless
  std::vector<dealii::BoundingBox<3>> boxes;  ///< of the mapping nodes
  std::shared_ptr<const MembraneTrace> trace;
};

/// Unit coordinates of a point of a membrane face, given the corners of the face.
UnitPoint on_face(const std::array<UnitPoint, 4>& corners, double s, double t);

/// Pairs of degrees of freedom of a handler that are one node of γ on its two sides.
struct SheetPairs {
  std::vector<std::array<DofIndex, 2>> pairs;  ///< {inner, outer}
  std::vector<int> vesicle;                    ///< of each pair
  /// First pair on a membrane.
  [[nodiscard]] const std::array<DofIndex, 2>& first_of(int of_vesicle) const {
    return pairs[static_cast<std::size_t>(std::find(vesicle.begin(), vesicle.end(), of_vesicle) - vesicle.begin())];
  }
  std::vector<int> index_of_inner;        ///< number of the pair of each degree of freedom, or −1
  std::vector<std::vector<int>> of_face;  ///< pairs on each face, Gauss–Lobatto lattice, first coordinate fastest
};
/// The pairs of a handler.
SheetPairs sheet_pairs(const Space& space, const dealii::DoFHandler<3>& handler);

/// Consecutive points on one face.
struct FaceRun {
  int face;
  Eigen::Index begin;
  Eigen::Index size;
};
std::vector<FaceRun> face_runs(const SurfacePoints& points);
/// Unit coordinates of such points in the inner or outer cell.
std::vector<UnitPoint> unit_points(const Space& space, const SurfacePoints& points, const FaceRun& run, Side side);

/// Consecutive points in one cell.
struct CellRun {
  unsigned cell;
  Eigen::Index begin;
  Eigen::Index size;
  std::vector<UnitPoint> units;
};
std::vector<CellRun> cell_runs(const VolumePoints& points);

/// Tensor points on every face; weights only for a quadrature rule.
SurfacePoints tensor_points(const Space& space, const std::vector<double>& nodes, const std::vector<double>& weights);
/// Gauss–Lobatto points of [0, 1]: the nodes of an element of this degree along an edge.
std::vector<double> edge_nodes(unsigned degree);
/// Lagrange polynomials of these nodes.
std::vector<dealii::Polynomials::Polynomial<double>> edge_polynomials(unsigned degree);

std::size_t peak_memory_bytes();

}  // namespace vehd::fem_check

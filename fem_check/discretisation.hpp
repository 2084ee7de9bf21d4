#pragma once

#include <memory>

#include "fem_check/types.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::fem_check {

struct Space;

/// Ranks that solve together: all ranks of MPI, or each rank separately.
enum class Ranks { all, each_alone };

/// Continuous elements of one degree on each side of γ, on a curved mesh. The two sides share no vertex, so a field can
/// jump across γ. Every rank stores the whole mesh; cells and unknowns are distributed.
/// Accuracy: area and volume of the membrane to 1e-6 (tests/fem_check/discretisation_test.cpp)
class Discretisation {
 public:
  /// @param mesh    block mesh with split interface
  /// @param degree  k of the elements; the geometry has degree k + 1
  /// @param points_per_edge  of a face of γ: Gauss points at which given surface fields are integrated; at least k + 2
  ///                         are used
  /// @throws std::invalid_argument for another mesh or a degree outside 1 … 10
  Discretisation(std::shared_ptr<const meshes::VolumeMesh> mesh, int degree, Ranks ranks = Ranks::all,
                 int points_per_edge = 0);

  /// Degree k of the elements.
  [[nodiscard]] int degree() const;
  /// Number of cells on both sides.
  [[nodiscard]] int n_cells() const;
  [[nodiscard]] int n_faces() const;  ///< of the membrane
  /// Gauss points along an edge of a face of γ at which given surface fields are integrated.
  [[nodiscard]] int points_per_edge() const;
  /// Number of nodes of the scalar element on both sides.
  [[nodiscard]] long n_nodes() const;

  /// Gauss points of γ, `per_edge` squared on every face.
  [[nodiscard]] SurfacePoints quadrature_points(int per_edge) const;
  /// Evenly spaced points, (intervals + 1)² on every face, edges included; first face coordinate fastest. No weights.
  [[nodiscard]] SurfacePoints lattice_points(int intervals) const;
  /// Finds the cells that contain points in space; a point on γ is assigned to either side.
  /// @throws LocationError for a point that lies in no cell
  [[nodiscard]] VolumePoints locate(const Vectors& points) const;
  /// Evenly spaced points, (intervals + 1)³ in every cell, x fastest.
  [[nodiscard]] VolumePoints volume_lattice(int intervals) const;

  [[nodiscard]] const std::shared_ptr<const Space>& space() const { return space_; }

 private:
  std::shared_ptr<const Space> space_;
};

}  // namespace vehd::fem_check

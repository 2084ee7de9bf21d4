#pragma once

#include <memory>

#include "fem_check/types.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::fem_check {

struct Space;

/// Who solves together: all ranks of MPI, or each rank everything on its own.
enum class Ranks { all, each_alone };

/// Continuous elements of one degree on each side of γ, on a curved mesh. The two sides share no vertex, so a field
/// may jump across γ. Every rank knows the whole mesh; cells and unknowns are divided.
/// Accuracy: area and volume of the membrane to 1e-6 (tests/fem_check/discretisation_test.cpp)
class Discretisation {
 public:
  /// @param mesh    block mesh with split interface
  /// @param degree  k of the elements; the geometry has degree k + 1
  /// @param points_per_edge  of a face of γ, Gauss points at which what is given there is integrated; k + 2 if that is
  ///                         more
  /// @throws std::invalid_argument for another mesh or a degree outside 1 … 10
  Discretisation(std::shared_ptr<const meshes::VolumeMesh> mesh, int degree, Ranks ranks = Ranks::all,
                 int points_per_edge = 0);

  /// Degree k of the elements.
  [[nodiscard]] int degree() const;
  /// Cells on both sides.
  [[nodiscard]] int n_cells() const;
  [[nodiscard]] int n_faces() const;  ///< of the membrane
  /// Gauss points along an edge of a face of γ, at which what is given there is integrated.
  [[nodiscard]] int points_per_edge() const;
  /// Nodes of the scalar element on both sides.
  [[nodiscard]] long n_nodes() const;

  /// Gauss points of γ, `per_edge` squared on every face.
  [[nodiscard]] SurfacePoints quadrature_points(int per_edge) const;
  /// Evenly spaced points, (intervals + 1)² on every face, edges included; first face coordinate fastest. No weights.
  [[nodiscard]] SurfacePoints lattice_points(int intervals) const;
  /// Points in space with their cells; a point of γ itself goes to either side.
  /// @throws LocationError for a point beyond the outer sphere
  [[nodiscard]] VolumePoints locate(const Vectors& points) const;
  /// Evenly spaced points, (intervals + 1)³ in every cell, x fastest.
  [[nodiscard]] VolumePoints volume_lattice(int intervals) const;

  [[nodiscard]] const std::shared_ptr<const Space>& space() const { return space_; }

 private:
  std::shared_ptr<const Space> space_;
};

}  // namespace vehd::fem_check

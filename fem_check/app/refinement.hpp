#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "fem_check/discretisation.hpp"
#include "meshes/box_mesh.hpp"
#include "meshes/frozen_shape.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::fem_check {

/// Resolution of the finite elements: one coarse curved mesh, rising degrees.
struct Refinement {
  int cells_per_edge = 3;  ///< along an edge of a block
  int blend_layers = 1;
  int shell_layers = 2;
  /// Thickness ratio of successive layers: the fine structure of the fields is confined to a thin inner layer; in the
  /// layers outside, the fields are smooth and a high degree resolves them.
  double shell_growth = 4.0;
  double blend_growth = 1.0;  ///< thickness of a layer inside over that of the next one towards the membrane
  /// Distance of the outer sphere from the farthest point of the membrane, over the radius √(area/4π) of the shape: the
  /// sphere encloses all sample points off the membrane.
  double outer_distance = 3.2;
  double outer_radius_of_two = 8.0;  ///< over the combined radius of two vesicles
  // For two vesicles, or one beside a wall: layers between membrane and box, and between boxes and outer sphere.
  int box_layers = 2, outer_layers = 2;
  double box_growth = 2.0, outer_growth = 2.0;
  /// Gauss points per edge of a face of γ, for the comparison and integrals of given surface fields; see resolve().
  int points_per_edge = 12;

  // Degrees, ascending, at least three.
  std::vector<int> potential_degrees{4, 5, 6, 7, 8, 9};
  std::vector<int> flow_degrees{4, 5, 6, 7, 8, 9};  ///< force given
  std::vector<int> shape_flow_degrees{4, 5, 6, 7, 8, 9};
  double potential_target = 1e-5;  ///< relative change below which the degree is not raised further
  double flow_target = 1e-4;
  double charging_target = 1e-3;       ///< the same for V_m advanced in time, also for its steps
  double potential_tolerance = 3e-12;  ///< of the linear solvers
  double flow_tolerance = 1e-7;

  static Refinement finest() { return {}; }
  /// If forces are concentrated at ends or rims, smaller cells gain more than higher degrees.
  static Refinement of_strongly_bent();
  /// The bent cells of a bowl, see meshes::cells_have_to_be_relaxed(): here degrees gain more than smaller cells.
  static Refinement of_strongly_bent_bowl();
  /// The one of these three that suits the curvature of the shape.
  static Refinement following(const meshes::FrozenShape& shape);
  /// Ensures three points on γ for each wave of fields of this harmonic degree. Otherwise unresolved parts of a force
  /// would count as work on smooth displacements: 7e-8 of it for degree 80 with 12 points and 4 cells along an edge,
  /// whereas 16 points leave 1e-11.
  void resolve(int degree);
  /// Three levels each, of odd degree: a field that is even about the middle of a cell, as about the poles of an
  /// axisymmetric shape, gains nothing from the next odd degree, and an odd field nothing from an even degree. A step
  /// of one degree can then hide the remaining error.
  static Refinement quick();
  /// quick(), with the cells of a bowl if the shape is one: on larger cells the changes from degree to degree do not
  /// show the errors at its rim.
  static Refinement quick_of(const meshes::FrozenShape& shape);
  /// With an even number of cells along an edge, no cell is centred at a pole.
  static Refinement quick_of_two();
};

/// Options of the mesh of one shape.
meshes::BlockMeshOptions block_mesh_options(const Refinement& refinement, const meshes::FrozenShape& shape);

/// Options of the mesh about two shapes.
meshes::BoxMeshOptions two_vesicle_options(const Refinement& refinement,
                                           const std::array<meshes::FrozenShape, 2>& shapes);

/// Options of the mesh about a shape beside a wall.
meshes::BoxMeshOptions wall_mesh_options(const Refinement& refinement, const meshes::FrozenShape& shape,
                                         const meshes::Wall& wall);

/// Discretisations on the mesh of one or two shapes, or of one beside a wall.
class Meshes {
 public:
  /// @throws MeshError if there are more shapes, or if the blocks cannot follow them
  Meshes(const std::vector<meshes::FrozenShape>& shapes, const Refinement& refinement,
         const std::optional<meshes::Wall>& wall = {});

  /// Discretisation of this degree, made once.
  [[nodiscard]] const Discretisation& discretise(int degree);
  [[nodiscard]] double outer_radius() const { return mesh_->outer_radius(); }

 private:
  std::shared_ptr<const meshes::VolumeMesh> mesh_;
  int points_per_edge_;
  std::map<int, Discretisation> discretisations_;
};

}  // namespace vehd::fem_check

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

/// How fine the finite elements get: one coarse curved mesh, rising degrees.
struct Refinement {
  int cells_per_edge = 3;  ///< of a block
  int blend_layers = 1;
  int shell_layers = 2;
  /// Of the layers' thickness: the fine structure of the fields ends in a thin inner layer, and the layers outside
  /// carry the smooth rest at high degree.
  double shell_growth = 4.0;
  double blend_growth = 1.0;  ///< thickness of a layer inside over that of the next one towards the membrane
  /// Of the outer sphere from the farthest point of the membrane, over the radius √(area/4π) of the shape: it encloses
  /// all points off the membrane.
  double outer_distance = 3.2;
  double outer_radius_of_two = 8.0;  ///< over the radius of two together
  // Of two vesicles, or one beside a wall: between a membrane and its box, and from the boxes to the outer sphere.
  int box_layers = 2, outer_layers = 2;
  double box_growth = 2.0, outer_growth = 2.0;
  /// Gauss points on each face of γ, of the comparison and of the integrals of what is given there; see resolve().
  int points_per_edge = 12;

  // Degrees, rising, three at least.
  std::vector<int> potential_degrees{4, 5, 6, 7, 8, 9};
  std::vector<int> flow_degrees{4, 5, 6, 7, 8, 9};  ///< force given
  std::vector<int> shape_flow_degrees{4, 5, 6, 7, 8, 9};
  double potential_target = 1e-5;  ///< relative change at which degrees stop rising before the last
  double flow_target = 1e-4;
  double charging_target = 1e-3;       ///< the same of V_m that is advanced in time, of its steps too
  double potential_tolerance = 3e-12;  ///< of the linear solvers
  double flow_tolerance = 1e-7;

  static Refinement finest() { return {}; }
  /// Where forces are as narrow as ends and rims, smaller cells gain more than degrees do.
  static Refinement of_strongly_bent();
  /// The bent cells of a bowl, see meshes::cells_have_to_be_relaxed(), want degrees more than they want to be small.
  static Refinement of_strongly_bent_bowl();
  /// The one of these that follows the bends of the shape.
  static Refinement following(const meshes::FrozenShape& shape);
  /// As many points on γ as fields of a degree in harmonics need: three for each wave. What a force has
  /// between points would else be work on smooth displacements: 7e-8 of it for a degree of 80, 12 points and 4 cells
  /// along an edge, where 16 points leave 1e-11.
  void resolve(int degree);
  /// Three levels each, of odd degree: a field that is even about the middle of a cell, as about the poles of an
  /// axisymmetric shape, gains nothing from the next odd degree, and one that is odd nothing from an even one. A step
  /// of one degree then hides the error that is left.
  static Refinement quick();
  /// An even number of cells along an edge has no cell about a pole.
  static Refinement quick_of_two();
};

/// Of a shape.
meshes::BlockMeshOptions block_mesh_options(const Refinement& refinement, const meshes::FrozenShape& shape);

/// About two shapes.
meshes::BoxMeshOptions two_vesicle_options(const Refinement& refinement,
                                           const std::array<meshes::FrozenShape, 2>& shapes);

/// About a shape beside a wall.
meshes::BoxMeshOptions wall_mesh_options(const Refinement& refinement, const meshes::FrozenShape& shape,
                                         const meshes::Wall& wall);

/// The mesh of one or two shapes, or of one beside a wall.
class Meshes {
 public:
  /// @throws MeshError if there are more shapes, or if the blocks cannot follow them
  Meshes(const std::vector<meshes::FrozenShape>& shapes, const Refinement& refinement,
         const std::optional<meshes::Wall>& wall = {});

  /// Made once for each degree.
  [[nodiscard]] const Discretisation& discretise(int degree);
  [[nodiscard]] double outer_radius() const { return mesh_->outer_radius(); }

 private:
  std::shared_ptr<const meshes::VolumeMesh> mesh_;
  int points_per_edge_;
  std::map<int, Discretisation> discretisations_;
};

}  // namespace vehd::fem_check

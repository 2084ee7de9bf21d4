#pragma once

#include <array>
#include <string>
#include <string_view>

#include "bie/files/run_reader.hpp"
#include "bie/pictures/renderer.hpp"

namespace vehd {

/// What the colours of a shape show.
enum class ShapeField { none, potential, charge, tension, force, curvature };

/// Their names on the command line.
constexpr std::array<std::string_view, 6> shape_field_names = {"none", "V_m", "q", "tension", "force", "curvature"};

/// How a field is called in pictures, and its physical dimension by its name in scene/units.hpp.
struct FieldLabel {
  std::string_view text;
  std::string_view dimension;
};
FieldLabel label_of(ShapeField field);

/// V_m, without it the tension, without that the curvature.
ShapeField default_field(const RunReader& run, std::size_t snapshot);

/// @throws InputError that names what there is, if the snapshot does not have what the field needs
void require_field(const RunReader& run, std::size_t snapshot, ShapeField field);

/// One snapshot, its centroid in the origin.
struct Shape {
  double time = 0.0;
  RenderMesh mesh;
  Vector values;     ///< of the field, in numbers of the scene; zero without one
  Vector weights;    ///< area that each value stands for
  Matrix3 gyration;  ///< mean of x x^T over the area
};

/// @param grid_order  degree of the grid that is drawn, at least that of the snapshot
Shape shape_of(const RunReader& run, std::size_t snapshot, ShapeField field, int grid_order);

}  // namespace vehd

#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/pictures/renderer.hpp"

namespace vehd {

/// Field shown by the colours of a shape.
enum class ShapeField {
  none,
  potential,
  charge,
  tension,
  force,
  curvature,
  potential_amplitude,
  potential_phase,
  charge_amplitude,
  poration,
  conductance,
  capacitance,
  pump_current,
  bending_modulus,
  spontaneous_curvature
};

/// Their names on the command line.
constexpr std::array<std::string_view, 15> shape_field_names = {"none",
                                                                "V_m",
                                                                "q",
                                                                "tension",
                                                                "force",
                                                                "curvature",
                                                                "V_m_amplitude",
                                                                "V_m_phase",
                                                                "q_amplitude",
                                                                "poration",
                                                                "conductance",
                                                                "capacitance",
                                                                "pump_current",
                                                                "bending_modulus",
                                                                "spontaneous_curvature"};

/// How a field is called in pictures.
struct FieldLabel {
  std::string_view text;
  std::string_view dimension;  ///< by its name in scene/units.hpp
  std::string_view dataset{};  ///< in run.h5; empty of a computed field
  bool sign_matters = false;   ///< even where the values of a run have one sign alone
};
FieldLabel label_of(ShapeField field);

/// V_m, or its amplitude in an averaged field, without it the tension, without that the curvature.
ShapeField default_field(const RunSnapshot& snapshot);

/// @throws InputError that names the fields of the snapshot, if it does not have the dataset
void require_field(const RunSnapshot& snapshot, ShapeField field);

/// One snapshot with all its vesicles, the centroid of their membranes together in the origin.
struct Shape {
  double time = 0.0;
  RenderMesh mesh;
  Vector values;     ///< of the field, in numbers of the scene; zero without one
  Vector weights;    ///< area that each value stands for
  Matrix3 gyration;  ///< mean of x x^T over the area
  Vector3 centre;    ///< where that centroid is
};

/// Data of one vesicle for a picture.
struct VesicleCoefficients {
  Matrix position;  ///< [n_coefficients x 3]
  Matrix field;     ///< [n_coefficients x 1]; of the force x 3; real and imaginary part of what a complex amplitude
                    ///< gives; empty of what is computed from the position
};

/// Data of one snapshot for a picture.
struct ShapeCoefficients {
  double time = 0.0;
  std::vector<VesicleCoefficients> vesicles;
};
ShapeCoefficients read_shape(const RunSnapshot& snapshot, ShapeField field);

/// @param field  that was read
/// @param grid_order  degree of the grid that is drawn, at least that of the snapshot
Shape shape_of(const ShapeCoefficients& read, ShapeField field, int grid_order);

}  // namespace vehd

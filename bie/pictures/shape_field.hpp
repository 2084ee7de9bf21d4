#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/pictures/renderer.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Field shown by the colours of a shape.
struct ShapeField {
  enum class Values {
    none,
    curvature,
    force,      ///< magnitude of the sum of all forces
    dataset,    ///< values of one dataset
    amplitude,  ///< |z| of two datasets, its real and imaginary part
    phase       ///< arg z of the same, in degrees
  };

  std::string_view name;  ///< on the command line
  Values values;
  std::string_view text{};                     ///< in pictures
  std::string_view dimension = "1";            ///< its name in scene/units.hpp
  std::array<std::string_view, 2> datasets{};  ///< in run.h5; empty if none is read
  bool sign_matters = false;                   ///< colours diverge even if the values of a run have one sign
};

/// All fields. A new one is a row here.
inline constexpr std::array shape_fields = {
    ShapeField{"none", ShapeField::Values::none},
    ShapeField{"V_m", ShapeField::Values::dataset, "V_m", "potential", {"Vm"}, true},
    ShapeField{"q", ShapeField::Values::dataset, "q", "potential/length", {"q"}, true},
    ShapeField{"tension", ShapeField::Values::dataset, "tension λ", "force/length", {"tension"}},
    ShapeField{"force", ShapeField::Values::force, "force |f|", "force/area"},
    ShapeField{"curvature", ShapeField::Values::curvature, "curvature H", "1/length"},
    ShapeField{"V_m_amplitude", ShapeField::Values::amplitude, "|V_m|", "potential", {"Vm_real", "Vm_imaginary"}},
    ShapeField{"V_m_phase", ShapeField::Values::phase, "phase of V_m (degrees)", "1", {"Vm_real", "Vm_imaginary"}},
    ShapeField{"q_amplitude", ShapeField::Values::amplitude, "|q|", "potential/length", {"q_real", "q_imaginary"}},
    ShapeField{"poration", ShapeField::Values::dataset, "X", "1", {"poration"}},
    ShapeField{"conductance", ShapeField::Values::dataset, "G_m", "conductance/area", {"conductance"}},
    ShapeField{"capacitance", ShapeField::Values::dataset, "C_m", "capacitance/area", {"capacitance"}},
    ShapeField{"pump_current", ShapeField::Values::dataset, "J_p", "current/area", {"pump_current"}},
    ShapeField{"bending_modulus", ShapeField::Values::dataset, "κ_B", "energy", {"bending_modulus"}},
    ShapeField{"spontaneous_curvature", ShapeField::Values::dataset, "c", "1/length", {"spontaneous_curvature"}}};

/// @param name  name of one of the fields
const ShapeField& shape_field(std::string_view name);

/// Text of the field in pictures of this scene: of poration that of its model, X or ln(N/N₀).
std::string field_text(const ShapeField& field, const Scene& scene);

/// V_m, or its amplitude in an averaged field; without it the tension; without both the curvature.
const ShapeField& default_field(const RunSnapshot& snapshot);

/// @throws InputError that names the fields of the snapshot, if it lacks the dataset
void require_field(const RunSnapshot& snapshot, const ShapeField& field);

/// One snapshot with all its vesicles, relative to the common centroid of their membranes.
struct Shape {
  double time = 0.0;
  RenderMesh mesh;
  Vector values;     ///< of the field, in units of the scene; zero without one
  Vector weights;    ///< area that each value represents
  Matrix3 gyration;  ///< mean of x x^T over the area
  Vector3 centre;    ///< the common centroid
};

/// Data of one vesicle for a picture.
struct VesicleCoefficients {
  Matrix position;  ///< [n_coefficients x 3]
  Matrix field;     ///< [n_coefficients x 1]; forces x 3; complex amplitudes x 2 (real, imaginary); empty if not read
};

/// Data of one snapshot for a picture.
struct ShapeCoefficients {
  double time = 0.0;
  std::vector<VesicleCoefficients> vesicles;
};
ShapeCoefficients read_shape(const RunSnapshot& snapshot, const ShapeField& field);

/// @param field       as in read_shape
/// @param grid_order  degree of the drawn grid, raised to that of the snapshot if lower
Shape shape_of(const ShapeCoefficients& read, const ShapeField& field, int grid_order);

}  // namespace vehd

#pragma once

#include "bie/files/run_reader.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/scene/scene.hpp"
#include "bie/support/types.hpp"

/// The membrane at time 0 of a scene of one vesicle, placed and in units of the scene: coefficients up to its degree.
namespace vehd {

struct InitialMembrane {
  Matrix position;   ///< x(θ, φ), [n_coefficients x 3]; θ from +z
  Vector potential;  ///< V_m, [n_coefficients], if the scene takes it from its shape file; otherwise empty
};

/// @throws InputError if the shape file cannot be used
/// Accuracy: shapes are truncated to the order of the scene (tests/scene/initial_shape_test.cpp)
InitialMembrane initial_membrane(const Scene& scene);

/// The position of initial_membrane, [n_coefficients x 3].
Matrix initial_position(const Scene& scene);

/// Does a shape of this kind have the area 4π unless the scene gives an area or a scale?
bool has_unit_size(ShapeKind kind);

/// Does the shape have the reduced volume of the scene, if one is given? An ellipsoid, a radial shape or one from a
/// file is moved towards a sphere or away from it to reach that volume, which may fail.
bool has_reduced_volume(const Scene& scene);

/// The snapshot with which a scene of [shape] kind "file" starts.
/// @throws InputError if there is none
RunSnapshot start_snapshot(const RunReader& run, const Scene& scene);

/// Adds time and checksum of its snapshot to a scene of [shape] kind "file" that lacks them. They fix the shape, which
/// the path alone does not.
/// @return whether the snapshot has the checksum of the scene
/// @throws InputError if there is no snapshot
bool fix_snapshot(Scene& scene, const RunReader& run);

/// Smallest and largest value.
struct Extremes {
  double least = 0.0, most = 0.0;
};

/// Extremes of the radius of a radial shape on a fine grid; NaN if some radius is not finite.
Extremes radius_extremes(const Scene& scene);

/// Factor of a property over the parameter sphere, coefficients [(order + 1)²].
/// @param order  to which a cap is truncated
/// Accuracy: harmonics exact, a cap to its truncation, see varying_factor_truncation
Vector varying_factor(const VaryingProperty& varying, int order);

/// Largest truncation error of a cap, over the difference of its two factors; 0 for harmonics.
double varying_factor_truncation(const VaryingProperty& varying, int order);

/// The spatially varying properties, rotated with the shape.
MembraneMaterial initial_material(const Scene& scene);

}  // namespace vehd

#pragma once

#include "bie/scene/scene.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Coefficients of the scene's order.
struct InitialMembrane {
  Matrix position;   ///< x(θ, φ), [n_coefficients x 3]; θ from +z
  Vector potential;  ///< V_m where the scene takes it from its shape file, otherwise empty
};

/// The membrane of a scene of one vesicle at time 0, placed and in units of the scene. @throws InputError if the shape
/// file cannot be used
///
/// Accuracy: shapes are truncated to the order of the scene (tests/scene/initial_shape_test.cpp)
InitialMembrane initial_membrane(const Scene& scene);

/// Its position alone.
Matrix initial_position(const Scene& scene);

/// Smallest and largest value.
struct Extremes {
  double least = 0.0, most = 0.0;
};

/// Of the radius of a radial shape over a fine grid; NaN if some radius is not finite.
Extremes radius_extremes(const Scene& scene);

}  // namespace vehd

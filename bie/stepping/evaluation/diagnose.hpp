#pragma once

#include <array>
#include <tuple>

#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/state/frame.hpp"

namespace vehd {

/// History quantities of one membrane, with the axes of its state in place of the laboratory's. Extrema are those of
/// the surface between the nodes to third order in the spacing.
/// @param model                 in the frame of the state
/// @param quadrature_tolerance  of LayerCheck::error
/// @param previous              diagnostics with the same shape and operators, whose checks are taken over; or null
/// Accuracy: spectral; extents of ellipsoids to 1e-13, inclinations to 1e-8 degrees, V_m at the north pole to 1e-12
/// (tests/stepping/evaluation/diagnostics_test.cpp)
VesicleDiagnostics diagnose(const Model& model, const VesicleModel& vesicle_model, const MembraneSpace& space,
                            double quadrature_tolerance, const VesicleState& vesicle, const VesicleSolution& solution,
                            const VesicleFields& fields, const VesicleDiagnostics* previous = nullptr);

/// History quantities of a state in a frame: extents, inclination and the values at the north pole are computed again
/// along the axes of the laboratory.
/// @param fine  with all longitudes: an extremum of an axisymmetric surface can lie on any of them
/// @param s     the surface on its grid
VesicleDiagnostics along_lab_frame_axes(VesicleDiagnostics d, const Frame& frame, const SphereTransform& fine,
                                        const Surface& s, const SurfaceFields& membrane, const VesicleFields& fields);

/// Particle stress, dipole moment and power of one vesicle about its own centroid, in the axes of the state. Frozen
/// shapes have no flow and no stress.
/// @param solution  with its membrane
/// @param time      and limit: those with which the fields were solved
/// Accuracy: spectral; stress of an inextensible sphere in linear flows and dipole of a sphere in a field to 1e-11
/// (tests/stepping/evaluation/rheology_test.cpp)
/// Source: Batchelor 1970; two viscosities: Pozrikidis 1992
Rheology find_rheology(const Model& model, const VesicleModel& vesicle, double time, Limit limit,
                       const VesicleState& state, const VesicleSolution& solution, const VesicleFields& fields);

/// A field at a point of the parameter sphere.
/// @param field  coefficients [n_coefficients]
double value_at(const SpherePoint& point, const Vector& field);

/// Components of a vector, to be assigned to three columns by std::tie.
inline std::tuple<double, double, double> components(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Values of a field at the outermost crossings of the surface with the line through a point along ±direction, + first,
/// see highest_on_line; NaN if the line misses the surface.
/// @param direction  not zero; along z if the transform is that of axisymmetric fields
/// @param fine       with as many longitudes as the degree requires
/// @param point      relative to the mean of the position
/// @param position, field  coefficients, [n_coefficients x 3] and [n_coefficients]
/// Accuracy: rounding; of V = z on turned ellipsoids to 1e-12 (tests/stepping/evaluation/diagnostics_test.cpp)
std::array<double, 2> values_at_poles(const Vector3& direction, const SphereTransform& fine, const Vector3& point,
                                      const Matrix& position, const Vector& field);

}  // namespace vehd

#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/state/frame.hpp"

namespace vehd {

/// What the model says of one membrane and its surroundings, in the frame of the state.
struct DiagnosedModel {
  FlowParameters flow{};
  double spontaneous_curvature = 0.0;  ///< c
  Vector3 field = Vector3::Zero();     ///< E_∞ where the waveform is 1
  std::optional<PorationCriterion> criterion{};
  std::shared_ptr<const PorationReaction> reaction{};
  ChargingParameters charging{};
  std::optional<Wall> wall{};
  bool by_place = false;  ///< some properties differ from place to place, or there is a pump
};

/// That of a vesicle of a model.
DiagnosedModel diagnosed_model(const Model& model, const VesicleModel& vesicle);

/// History quantities of one membrane, with its own axes for those of the laboratory. Extrema are those of the surface
/// between the nodes to third order in the spacing.
/// @param quadrature_tolerance  of LayerCheck::error
/// @param previous              where shape and operators are those of a former moment: what it found of them
/// Accuracy: spectral; extents of ellipsoids to 1e-13, inclinations to 1e-8 degrees, V_m at the north pole to 1e-12
/// (tests/stepping/evaluation/diagnostics_test.cpp)
VesicleDiagnostics diagnose(const DiagnosedModel& model, const MembraneSpace& space, double quadrature_tolerance,
                            const VesicleState& vesicle, const VesicleSolution& solution, const VesicleFields& fields,
                            const VesicleDiagnostics* previous = nullptr);

/// The same quantities where the state is that of a frame: extents, inclination and the values at the north pole are
/// found anew along the axes of the laboratory.
/// @param fine  of all longitudes: an extreme of an axisymmetric surface lies on any of them
/// @param s     the surface on its grid
VesicleDiagnostics along_lab_frame_axes(VesicleDiagnostics d, const Frame& frame, const SphereTransform& fine,
                                        const Surface& s, const SurfaceFields& membrane, const VesicleFields& fields);

}  // namespace vehd

#include "bie/stepping/evaluation/lab_frame_output.hpp"

#include <utility>

#include "bie/geometry/surface.hpp"
#include "bie/stepping/evaluation/diagnose.hpp"

namespace vehd {

LabFrameOutput::LabFrameOutput(const Frame& frame, const NumericalSettings& settings) : frame_(frame) {
  if (!frame.is_rotated()) return;
  const int order = settings.upsampling * settings.order;
  // A multiple of four puts nodes on ±x and ±y of the frame, where bodies along coordinate axes are widest.
  fine_.emplace(settings.order, make_grid(order, 4 * (order / 2 + 1)));
}

namespace {

/// Transforms centroid, its velocity, net force, place of poration and rheology from the frame to the laboratory.
void place(const Frame& frame, VesicleDiagnostics& d) {
  const auto turned = [&](double x, double y, double z) -> Vector3 { return frame.axes * Vector3(x, y, z); };
  const auto point = [&](double x, double y, double z) -> Vector3 { return frame.origin + turned(x, y, z); };
  std::tie(d.centroid_x, d.centroid_y, d.centroid_z) = components(point(d.centroid_x, d.centroid_y, d.centroid_z));
  std::tie(d.centroid_velocity_x, d.centroid_velocity_y, d.centroid_velocity_z) =
      components(turned(d.centroid_velocity_x, d.centroid_velocity_y, d.centroid_velocity_z));
  std::tie(d.poration_x, d.poration_y, d.poration_z) = components(point(d.poration_x, d.poration_y, d.poration_z));
  std::tie(d.net_force_x, d.net_force_y, d.net_force_z) =
      components(turned(d.net_force_x, d.net_force_y, d.net_force_z));
  d.rheology = rotated(frame.axes, frame.origin, d.rheology);
}

}  // namespace

Diagnostics LabFrameOutput::diagnostics(Diagnostics d) const {
  for (VesicleDiagnostics& vesicle : d.vesicles) place(frame_, vesicle);
  return d;
}

Diagnostics LabFrameOutput::diagnostics(const Diagnostics& d, const State& state, const Fields& fields) const {
  if (!fine_) return diagnostics(d);
  Diagnostics result;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleState& vesicle = state.vesicles[a];
    result.vesicles.push_back(along_lab_frame_axes(
        d.vesicles[a], frame_, *fine_, make_surface(*fine_, vesicle.position), vesicle, fields.vesicles[a]));
  }
  return diagnostics(std::move(result));
}

}  // namespace vehd

#include "bie/stepping/evaluation/lab_frame_output.hpp"

#include "bie/geometry/surface.hpp"
#include "bie/stepping/evaluation/diagnose.hpp"

namespace vehd {

LabFrameOutput::LabFrameOutput(const Frame& frame, const NumericalSettings& settings) : frame_(frame) {
  if (!frame.is_rotated()) return;
  const int order = settings.upsampling * settings.order;
  // A multiple of four puts nodes on ±x and ±y of the frame, where bodies along coordinate axes are widest.
  fine_.emplace(settings.order, make_grid(order, 4 * (order / 2 + 1)));
}

Diagnostics LabFrameOutput::diagnostics(const Diagnostics& d, const State& state, const Fields& fields) const {
  if (!fine_) return d;
  Diagnostics result;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleState& vesicle = state.vesicles[a];
    result.vesicles.push_back(along_lab_frame_axes(
        d.vesicles[a], frame_, *fine_, make_surface(*fine_, vesicle.position), vesicle, fields.vesicles[a]));
  }
  return result;
}

}  // namespace vehd

#include "bie/stepping/laboratory.hpp"

#include "bie/geometry/surface.hpp"
#include "bie/stepping/diagnostics.hpp"

namespace vehd {

Laboratory::Laboratory(const Frame& frame, const NumericalSettings& settings) : frame_(frame) {
  if (!frame.is_turned()) return;
  const int order = settings.upsampling * settings.order;
  // A multiple of four puts nodes on ±x and ±y of the frame, where bodies along coordinate axes are widest.
  fine_.emplace(settings.order, make_grid(order, 4 * (order / 2 + 1)));
}

Diagnostics Laboratory::diagnostics(const Diagnostics& d, const State& state, const Fields& fields) const {
  if (!fine_) return d;
  return along_laboratory_axes(d, frame_, *fine_, make_surface(*fine_, state.position), state, fields);
}

}  // namespace vehd

#pragma once

#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// The same fields in degrees up to `order`: cut, or continued by zeros. A membrane of another degree than before has
/// nothing to recycle, see RecycledScalars.
VesicleState resized(VesicleState vesicle, int order);
/// Fields of one membrane likewise.
VesicleFields resized(VesicleFields fields, int order);
/// Every membrane in degrees up to `order`.
State resized(State state, int order);
/// The fields of every membrane likewise.
Fields resized(Fields fields, int order);

/// Degree of the vesicle that has the highest.
int highest_order_of(const State& state);

}  // namespace vehd

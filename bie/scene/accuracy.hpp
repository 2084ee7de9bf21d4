#pragma once

#include "bie/scene/scene.hpp"

namespace vehd {

/// Default of the highest degree of a run with a tolerance. The steps of such a run have the highest time order.
/// @param tolerance  > 0, relative
/// Accuracy: chosen so that runs reach the tolerance (docs/digits.md); tests/stepping/adaptive_evolution_test.cpp
/// requires errors below three times the tolerance
int default_order(double tolerance);

/// The scene at another tolerance, which sets degree and time order. A dt that bounds the steps of a tolerance is kept;
/// one that sets fixed steps is dropped.
Scene at_tolerance(Scene scene, double tolerance);

}  // namespace vehd

#pragma once

#include "bie/scene/scene.hpp"

namespace vehd {

/// Highest degree of a run with a tolerance where the scene names none. Its steps have the highest time order.
/// @param tolerance  > 0, relative
/// Accuracy: chosen so that runs deliver the tolerance (docs/digits.md; tests/stepping/adaptive_evolution_test.cpp
/// holds three times it)
int default_order(double tolerance);

/// The scene at a tolerance: degree and time order are those of the tolerance. A dt stays where it bounds the steps of
/// a tolerance; where it was the accuracy of the scene it is dropped.
Scene at_tolerance(Scene scene, double tolerance);

}  // namespace vehd

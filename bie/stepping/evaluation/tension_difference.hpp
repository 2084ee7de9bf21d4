#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// A tension over the membrane that has it; both 0 where there is none, or a sphere leaves its mean open.
struct TensionIntegrals {
  double sum = 0.0;        ///< ∫λ dA
  double magnitude = 0.0;  ///< ∫|λ| dA
};

TensionIntegrals tension_integrals(const VesicleSolution& solution, const VesicleFields& fields);

/// How much ∫λ dA of one state differs between two evaluations at different degrees: over tension_scale of the second,
/// the largest of all vesicles.
double tension_difference(const Model& model, const Evaluation& first, const Evaluation& second);

}  // namespace vehd

#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// Particle stress, dipole moment and power of one vesicle about its own centroid, in the axes of the state. Where
/// shapes are frozen nothing flows and there is no stress.
/// @param solution  with its membrane
/// @param time      and limit: where waveforms have the values that the fields were solved with
/// Accuracy: spectral; stress of an inextensible sphere in linear flows and dipole of a sphere in a field to 1e-11
/// (tests/stepping/evaluation/rheology_test.cpp)
/// Source: Batchelor 1970; two viscosities: Pozrikidis 1992
Rheology find_rheology(const Model& model, const VesicleModel& vesicle, double time, Limit limit,
                       const VesicleState& state, const VesicleSolution& solution, const VesicleFields& fields);

}  // namespace vehd

#pragma once

#include "bie/scene/scene.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/frame.hpp"
#include "bie/stepping/state/symmetry.hpp"

namespace vehd {

/// The problem that a run of a scene solves. All vectors are in the frame.
struct Problem {
  Frame frame;
  Model model;
  NumericalSettings settings;
  StepControl control;
  Symmetry symmetry;                 ///< used by the run: that of its start, or none if the scene says "off"
  std::vector<StartMembrane> start;  ///< of every vesicle
  std::vector<std::string> names{};  ///< empty for a single vesicle
};

/// Setup of an Evolution for the problem.
EvolutionSetup setup_of(const Problem& problem);

/// Times at which steps of the scene must end, without the discontinuities of waveforms.
EventTimes events_of(const Scene& scene);

/// @throws InputError if the shape file cannot be used
Problem problem_of(const Scene& scene);

/// Problem of a scene that continues a run. Frame and symmetry are those found at the start of that run, at the degree
/// start_order, because its state is expressed in them.
/// @param origin  state, in the laboratory frame, from which that run continued another: they were found in it
Problem problem_of(const Scene& scene, int start_order, const State* origin = nullptr);

/// The problem of another model, in laboratory coordinates, with the shape of the scene.
Problem problem_of(const Scene& scene, const Model& model);

}  // namespace vehd

#pragma once

#include "bie/scene/scene.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/frame.hpp"
#include "bie/stepping/state/symmetry.hpp"

namespace vehd {

/// The problem that a run of a scene solves. All vectors are those of the frame.
struct Problem {
  Frame frame;
  Model model;
  NumericalSettings settings;
  StepControl control;
  Symmetry symmetry;                 ///< that the run uses: that of its start, or none where the scene says "off"
  std::vector<StartMembrane> start;  ///< of every vesicle
  std::vector<std::string> names{};  ///< of several vesicles
};

/// For an Evolution.
EvolutionSetup setup_of(const Problem& problem);

/// When steps of the scene have to end; those of waveforms aside.
EventTimes events_of(const Scene& scene);

/// @throws InputError if the shape file cannot be used
Problem problem_of(const Scene& scene);

/// Of a scene that continues a run which began with the initial shape in another degree: its frame and symmetry were
/// found there, and its state is in them.
/// @param origin  state, in the laboratory, from which it continues another run: they were found in it
Problem problem_of(const Scene& scene, int start_order, const State* origin = nullptr);

/// The problem with another model, in laboratory coordinates, on the scene's shape.
Problem problem_of(const Scene& scene, const Model& model);

}  // namespace vehd

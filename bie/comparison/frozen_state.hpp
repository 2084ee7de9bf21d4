#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bie/physics/model.hpp"
#include "bie/scene/settings.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/state/symmetry.hpp"

namespace vehd {

/// One instant of a run, or the start of a scene, at which the membranes are held fixed and their fields compared.
struct FrozenState {
  std::string source;  ///< file from which it was read
  Model model;
  Symmetry symmetry;
  NumericalSettings settings;        ///< settings of its run
  State state;                       ///< time, x and V_m; V_m is empty without electricity
  Fields fields;                     ///< as stored by the run; at a jump of the forcing, those just after it
  std::vector<std::string> notes{};  ///< the time taken instead of the requested one; see also ReadingNotes
  std::vector<std::string> names{};  ///< names of the vesicles if there are several
  std::string time_text = "0";       ///< the time in a form in which times are given: "0.5 ms"
};

/// Largest number of vesicles that the finite elements mesh and solve for.
constexpr std::size_t most_checked_vesicles = 2;

/// The shapes only.
struct FrozenShape {
  std::string source;                ///< as above
  std::vector<Matrix> positions;     ///< x of each vesicle, coefficients [n_coefficients x 3]
  std::optional<Wall> wall{};        ///< beside them
  std::vector<std::string> notes{};  ///< as above
};

/// @param source  a run.h5, or a scene (.toml) whose initial state is computed in memory; settings only with a scene
/// @param time  time of the snapshot as text, see GivenTimes and choose_snapshot; absent: the last one. A scene has
///              time 0 only.
/// @throws InputError if there is no such time, the file cannot be used or has too many vesicles
FrozenState read_frozen_state(const SceneSource& source, const std::optional<std::string>& time);

/// Only the shapes of read_frozen_state; for a scene nothing is solved.
/// @throws InputError as read_frozen_state
FrozenShape read_frozen_shape(const std::filesystem::path& file, const std::optional<std::string>& time);

}  // namespace vehd

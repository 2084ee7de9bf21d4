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

/// One instant of a run, or the start of a scene, at which the membranes are held still and their fields are compared.
struct FrozenState {
  std::string source;  ///< file that it comes from
  Model model;
  Symmetry symmetry;
  NumericalSettings settings;        ///< that its run computes with
  State state;                       ///< time, x and V_m; V_m empty without electricity
  Fields fields;                     ///< as the run stored them; where the forcing jumps, those just after the jump
  std::vector<std::string> notes{};  ///< another time than the one asked for, see also ReadingNotes
  std::vector<std::string> names{};  ///< of several vesicles
};

/// Most vesicles that the finite elements mesh and solve for.
constexpr std::size_t most_checked_vesicles = 2;

/// The shapes alone.
struct FrozenShape {
  std::string source;                ///< as above
  std::vector<Matrix> positions;     ///< of each vesicle, coefficients [n_coefficients x 3]
  std::optional<Wall> wall{};        ///< beside them
  std::vector<std::string> notes{};  ///< as above
};

/// @param source  a run.h5, or a scene (.toml) whose initial state is computed in memory; settings go with a scene only
/// @param time  of the snapshot as people write it, see GivenTimes and choose_snapshot; absent: the last one. A scene
/// knows time 0 only.
/// @throws InputError if there is no such time, the file cannot be used or has too many vesicles
FrozenState read_frozen_state(const SceneSource& source, const std::optional<std::string>& time);

/// The shapes of read_frozen_state alone; for a scene nothing is solved.
/// @throws InputError as read_frozen_state
FrozenShape read_frozen_shape(const std::filesystem::path& file, const std::optional<std::string>& time);

}  // namespace vehd

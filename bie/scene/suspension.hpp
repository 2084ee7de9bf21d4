#pragma once

#include "bie/scene/scene.hpp"
#include "bie/scene/toml_values.hpp"

namespace vehd {

/// The vesicles of a scene with a table [suspension]: copies of that of the other tables, placed one after the other at
/// random where there is room for the whole of them, by names "0", "1", …. The same scene gives the same places.
/// @param one   with its table, which the result no longer has
/// @throws InputError "file:line: ..." where they are too many or do not fit, before any memory is taken for them
Scene placed_suspension(const Scene& one, const TomlFile& file);

}  // namespace vehd

#pragma once

#include <toml++/toml.h>

#include <string>

#include "bie/scene/scene.hpp"

namespace vehd {

/// The vesicles of a scene with a table [suspension]: copies of that of the other tables, placed one after the other at
/// random where there is room for the whole of them, by names "0", "1", …. The same scene gives the same places.
/// @param one   with its table, which the result no longer has
/// @param file  the tables, for the lines of messages
/// @param name  stands for the file there
/// @throws InputError "file:line: ..." where they are too many or do not fit, before any memory is taken for them
Scene placed_suspension(const Scene& one, const toml::table& file, const std::string& name);

}  // namespace vehd

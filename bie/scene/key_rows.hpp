#pragma once

#include <vector>

#include "bie/scene/schema.hpp"

namespace vehd {

/// All tables and all keys of a scene, made anew; others use scene_tables() and scene_keys(). A new key is a member in
/// scene.hpp and a row here; a new table needs a row in both.
std::vector<TableDescription> table_rows();
/// See table_rows.
std::vector<KeyDescription> key_rows();

}  // namespace vehd

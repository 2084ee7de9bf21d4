#pragma once

#include "bie/scene/scene.hpp"
#include "bie/scene/toml_values.hpp"

/// Conditions that tie several values of a scene together; single values are checked against the key table.
namespace vehd {

/// Of a scene of one vesicle, its shape file included. Its V_m is that of the shape file where there is one and the
/// scene does not say otherwise. A scale that the file or the scene alone has is an error where a value needs it: the
/// length of the shape, unless [shape] sets its area, the time of a snapshot, and the potential.
/// @param file      that of the vesicle
/// @param is_heavy  another vesicle beside it has a weight
/// @throws InputError "file:line: ..." at the key to blame
void check_scene(Scene& scene, const TomlFile& file, bool is_heavy);

/// Of all vesicles: each is outside all others, what is solved for all of them at once is possible, and the symmetry is
/// there that the scene insists on.
/// @param file  with its tables [[vesicle]]
/// @throws InputError "file:line: ..." at the vesicle to blame
void check_vesicles(const Scene& scene, const TomlFile& file);

}  // namespace vehd

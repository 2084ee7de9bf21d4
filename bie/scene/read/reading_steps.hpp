#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "bie/scene/read/toml_values.hpp"

/// The steps of parse_scene on a scene file, in their order. Each throws InputError "file:line: ..." at the
/// key to blame.
namespace vehd {

/// Fills the scales that [units] leaves out from values of the scene that are given in SI units, so that the vesicle's
/// radius √(area/4π), the viscosity, the shortest time and the membrane capacitance are 1, each where it is the one to
/// fix a scale. A scale without such a value stays absent. The shortest time is what is fastest in the scene: a pulse,
/// the period of a waveform, the time of a rate of flow, and, with the reference length L and viscosity μ, the charging
/// time L C_m (1/σ_i + 1/(2σ_e)), the electric time μ/(ε E²) and the bending time μ L³/κ_B. A value that is to be
/// refused is refused here: other keys would be blamed for a scale that it does not give.
void derive_reference_scales(UnitsScene& units, const TomlFile& file);

/// Keys whose units could determine a scale of [units], as messages name them: "area" in [shape].
std::string source_of_scale(std::string_view scale);

/// Replaces every `path` of a waveform or of a spatially varying property with the numbers of its file: lines of
/// numbers apart by blanks or a comma; # starts a comment. A run so knows them even when the file is gone.
/// @param folder  where a relative path starts
void read_number_files(Scene& scene, const std::filesystem::path& folder);

/// Times and values of a waveform; `name` stands for the file in messages.
void read_waveform_rows(WaveformScene& waveform, std::istream& stream, const std::string& name);

/// Conditions that tie values of one vesicle together, its shape file included; single values are checked against the
/// key table. V_m is that of the shape file where there is one and the scene does not say otherwise. A scale that the
/// file or the scene alone has is an error where a value needs it: the length of the shape, unless [shape] sets its
/// area, the time of a snapshot, and the potential.
/// @param file      that of the vesicle
/// @param is_heavy  another vesicle beside it has a weight
void check_scene(Scene& scene, const TomlFile& file, bool is_heavy);

/// The part of check_scene about undulations.
void check_undulations(const Scene& scene, const TomlFile& file);

/// The vesicles of a scene with a table [suspension]: copies of that of the other tables, placed one after the other at
/// random where there is room for the whole of them, by names "0", "1", …. The same scene gives the same places.
/// Vesicles that are too many or do not fit are refused before any memory is taken for them.
/// @param one  with its table, which the result no longer has
Scene placed_suspension(const Scene& one, const TomlFile& file);

/// Conditions of all vesicles together: each is outside all others, what is solved for all of them at once is possible,
/// and the symmetry is there that the scene insists on.
/// @param file  with its tables [[vesicle]]
void check_vesicles(const Scene& scene, const TomlFile& file);

/// Conditions of a scene with a wall: every membrane is on its side, and what is applied far away meets the conditions
/// there.
/// @param file  with its tables [[vesicle]]
void check_wall(const Scene& scene, const TomlFile& file);

}  // namespace vehd

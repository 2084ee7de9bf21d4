#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "bie/scene/read/toml_values.hpp"

/// Steps of parse_scene, in their order. Each throws InputError "file:line: ..." with the place of the faulty key.
namespace vehd {

/// Fills the scales that [units] leaves out from values that the scene gives in SI units: the vesicle's radius
/// √(area/4π), the viscosity, the shortest time and the membrane capacitance become 1, each if its scale is left out. A
/// scale without such a value stays absent. The shortest time is the least of the durations, periods and 1/frequency
/// (not of an averaged field) of the waveforms of flow and field, the time of a flow rate and, with the reference
/// length L and viscosity μ, the charging time L C_m (1/σ_i + 1/(2σ_e)), the electric time μ/(ε E²) and the bending
/// time μ L³/κ_B. Invalid values are refused here: later messages would blame other keys.
void derive_reference_scales(UnitsScene& units, const TomlFile& file);

/// Keys whose values could determine a scale of [units], as messages name them: "area" in [shape].
std::string source_of_scale(std::string_view scale);

/// Replaces every `path` of a waveform or of a spatially varying property with the numbers of its file: lines of
/// numbers separated by blanks or a comma; # starts a comment. A run can then continue without the file.
/// @param file    of the scene
/// @param folder  where a relative path starts
void read_number_files(Scene& scene, const TomlFile& file, const std::filesystem::path& folder);

/// Reads times and values of a waveform; `name` stands for the file in messages.
void read_waveform_rows(WaveformScene& waveform, std::istream& stream, const std::string& name);

/// Checks conditions between values of one vesicle, including its shape file; single values are checked against the key
/// table. V_m is taken from the shape file if that has one and the scene does not specify it. A scale that only the
/// file or only the scene has is an error if a value needs it: the length of the shape, unless [shape] sets its area;
/// the time of a snapshot; the potential.
/// @param file  of the vesicle
/// @param all   vesicles of the scene: a key that is common to them must have an effect on one
void check_scene(Scene& scene, const TomlFile& file, const std::vector<Scene>& all);

/// The part of check_scene about undulations.
void check_undulations(const Scene& scene, const TomlFile& file, const std::vector<Scene>& all);

/// The part of check_scene about poration.
void check_poration(const Scene& scene, const TomlFile& file);

/// Places the vesicles of a table [suspension]: copies of the vesicle of the other tables, with the names "0", "1", …,
/// one after the other at random positions with enough room. The result is reproducible. Counts above most_vesicles or
/// above the volume of the region are refused before memory is allocated.
/// @param one  with its table [suspension], which the result does not have
Scene placed_suspension(const Scene& one, const TomlFile& file);

/// Checks all vesicles together: each is outside all others, the settings allow a common solve, and the symmetry that
/// the scene requires is there.
/// @param file  with its tables [[vesicle]]
void check_vesicles(const Scene& scene, const TomlFile& file);

/// Checks a scene with a wall: every membrane is on its side, and the applied flow and field satisfy the conditions on
/// the wall.
/// @param file  with its tables [[vesicle]]
void check_wall(const Scene& scene, const TomlFile& file);

}  // namespace vehd

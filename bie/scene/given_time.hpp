#pragma once

#include <optional>
#include <string>

#include "bie/scene/output_units.hpp"

/// Times that people write outside of a scene, on a command line: "0.5 ms", or a number.
namespace vehd {

/// The fault in the text of a time, for any scene; empty if there is none.
std::string problem_of_time(const std::string& text);

/// A time as a number of a scene.
/// @param text  a number with a unit, or one without; 0 needs none
/// @param scales  of the scene
/// @param plain  unit of a number without one; absent: there has to be one
/// @throws InputError that says what is accepted
double number_of_time(const std::string& text, const std::optional<UnitsScene>& scales,
                      const std::optional<OutputUnit>& plain);

}  // namespace vehd

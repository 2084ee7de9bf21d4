#pragma once

#include <optional>
#include <string>

#include "bie/scene/output_units.hpp"

/// Times that a command line gives: "0.5 ms", or a number.
namespace vehd {

/// Error message for a text that is no time in any scene; empty if the text is valid.
std::string problem_of_time(const std::string& text);

/// A time in units of the scene.
/// @param text  a number with a unit, or one without; 0 needs none
/// @param scales  of the scene
/// @param plain  unit of a number without one; absent: a unit is required
/// @throws InputError that says what is accepted
double number_of_time(const std::string& text, const std::optional<UnitsScene>& scales,
                      const std::optional<OutputUnit>& plain);

}  // namespace vehd

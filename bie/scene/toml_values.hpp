#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

#include "bie/scene/schema.hpp"

/// From TOML nodes to values of the key table.
namespace vehd {

/// "file:line" of a node, or the option --set that gave it.
std::string place(const toml::node& node, const std::string& file);

/// @throws InputError with the problem at the key of a table, or at the table that lacks it
/// @param table  of the scene, "electric.waveform" included; it exists
[[noreturn]] void refuse_key(const toml::table& scene, std::string_view table, std::string_view key,
                             const std::string& file, const std::string& problem);

/// A number of any notation: an integer is the double nearest to it, as if it were written with a point.
/// @return nullopt if the node is no number
std::optional<double> number_of(const toml::node& node);

/// The value as written, cut to a readable length, with its type where that is not plain to see.
std::string shown(const toml::node& node);

/// What a key accepts, in words.
std::string accepted_text(const KeyDescription& key);

/// SI value of a number with a unit, within the range of its key.
/// @return nullopt of a plain number
/// @throws InputError as checked_value does of anything else
std::optional<double> si_number(const KeyDescription& key, const toml::node& node, const std::string& file,
                                const std::optional<UnitsScene>& units);

/// Value of the key's type within its range, dimensionless unless it is a quantity.
/// @param units  reference scales, with which a number may also be a text with an SI unit
/// @throws InputError naming place, value and what is accepted
Value checked_value(const KeyDescription& key, const toml::node& node, const std::string& file,
                    const std::optional<UnitsScene>& units);

}  // namespace vehd

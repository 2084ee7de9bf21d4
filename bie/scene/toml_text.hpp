#pragma once

#include <string>

#include "bie/scene/schema.hpp"

namespace vehd {

/// A value as TOML, numbers with as many digits as reading back exactly needs.
std::string to_toml(const Value& value);

/// The value of a key as TOML; a quantity in its SI unit.
std::string to_toml(const KeyDescription& key, const Value& value);

}  // namespace vehd

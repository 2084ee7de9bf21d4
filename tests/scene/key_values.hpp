#pragma once

#include <fmt/format.h>

#include <string>

#include "bie/scene/schema.hpp"

/// The number as a value of the key's type, among others that are in order; empty for keys that take no number.
/// @param unit  of a key that must have one
inline std::string value_with_number(const vehd::KeyDescription& key, const std::string& number,
                                     const std::string& unit = "m") {
  switch (key.type) {
    case vehd::ValueType::integer:
    case vehd::ValueType::number:
      return number;
    case vehd::ValueType::triple:
      return "[1, " + number + ", 1]";
    case vehd::ValueType::matrix:
      return "[[0, 0, 0], [0, 0, " + number + "], [0, 0, 0]]";
    case vehd::ValueType::axis_angle:
      return "[0, 0, 1, " + number + "]";
    case vehd::ValueType::numbers:
      return "[0, " + number + "]";
    case vehd::ValueType::modes:
      return "[{n = 2, m = 0, a = " + number + "}]";
    case vehd::ValueType::windows:
      return "[{from = 0, to = " + number + ", every = 1}]";
    case vehd::ValueType::quantity:
      return fmt::format("\"{} {}\"", number, unit);
    default:
      return "";
  }
}

#pragma once

#include <fmt/format.h>

#include <string>

#include "bie/scene/schema.hpp"

/// A valid value of the key's type that contains the number; empty for keys that take no number.
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

/// A valid scene except for the value of `key`; the table of the key contains nothing else that is read before it.
inline std::string scene_with(const vehd::KeyDescription& key, const std::string& value) {
  const std::string table(key.table);
  std::string text;
  const auto add_unless_own = [&](const std::string& name, const std::string& content) {
    if (table != name) text += "[" + name + "]\n" + content;
  };
  add_unless_own("shape", "kind = 'ellipsoid'\naxes = [1, 1, 2]\n");
  add_unless_own("numerics", "dt = 1\nend_time = 1\norder = 6\n");
  if (table == "flow.waveform") add_unless_own("flow", "kind = 'shear'\nrate = 1\n");
  if (table == "membrane.pump.waveform") add_unless_own("membrane.pump", "kind = 'harmonics'\ncurrent = 1\n");
  if (table == "electric.waveform") {
    add_unless_own("electric", "field = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 1\n");
  }
  text += "[" + table + "]\n";
  if (!key.kinds.empty()) {
    text += std::string(vehd::kind_key(table)->name) + " = '" + std::string(key.kinds.front()) + "'\n";
  } else if (table == "shape") {
    text += "kind = 'ellipsoid'\naxes = [1, 1, 2]\n";
  } else if (table == "suspension") {
    text += "kind = 'ball'\nradius = 9\n";
  }
  return text + std::string(key.name) + " = " + value + "\n";
}

#pragma once

#include <string>

#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"

/// Line 1 is [shape], line 4 [numerics], line 8 the first line that is appended.
inline std::string with_appended(const std::string& more) {
  return "[shape]\n"
         "kind = \"ellipsoid\"\n"
         "axes = [1.0, 1.0, 2.0]\n"
         "[numerics]\n"
         "dt = 0.1\n"
         "end_time = 1.0\n"
         "order = 8\n" +
         more;
}

inline vehd::Scene parsed(const std::string& text) { return vehd::parse_scene(text, "scene.toml", "/folder"); }

/// Message of the InputError that the text causes; empty if it causes none.
inline std::string message_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const vehd::InputError& error) {
    return error.what();
  }
  return "";
}

#pragma once

#include <string>

#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"

/// Line 1 is [shape], line 4 [numerics], line 8 the first appended line.
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

/// A giant vesicle in SI units, with the reference scales 10 um, 0.5 s, 1 mPa s, 1 mV.
inline std::string si_scene() {
  return "[units]\n"
         "length = \"10 um\"\n"
         "time = \"500 ms\"\n"
         "viscosity = \"1 mPa s\"\n"
         "potential = \"1 mV\"\n"
         "[shape]\n"
         "kind = \"prolate\"\n"
         "reduced_volume = 0.9\n"
         "area = \"1256.6370614359172 um^2\"\n"
         "[membrane]\n"
         "bending_modulus = \"2e-20 J\"\n"
         "capacitance = \"1 uF/cm^2\"\n"
         "conductance = \"100 S/m^2\"\n"
         "[fluid]\n"
         "viscosity = \"1 mPa s\"\n"
         "[flow]\n"
         "kind = \"shear\"\n"
         "rate = \"2 1/s\"\n"
         "[electric]\n"
         "field = [0, 0, \"0.1 kV/cm\"]\n"
         "conductivity_in = \"0.1 mS/cm\"\n"
         "conductivity_out = \"20 mS/m\"\n"
         "permittivity = \"80 eps0\"\n"
         "[numerics]\n"
         "dt = \"10 ms\"\n"
         "end_time = \"1 s\"\n";
}

inline vehd::Scene parsed(const std::string& text) { return vehd::parse_scene(text, "scene.toml", "/folder"); }

/// Message of the InputError caused by the text; empty if there is none.
inline std::string message_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const vehd::InputError& error) {
    return error.what();
  }
  return "";
}

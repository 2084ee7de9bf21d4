#pragma once

#include <fmt/format.h>

#include <regex>
#include <string>

/// A quick scene: order 6, bending, a field, 12 steps of 0.25, a snapshot every 0.5.
inline std::string quick_scene(const std::string& end_time = "3.0") {
  return "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]\n"
         "[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n"
         "[electric]\nfield = [0.0, 0.0, 0.5]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
         "[numerics]\norder = 6\ndt = 0.25\nend_time = " +
         end_time + "\n[output]\nevery = 0.5\n";
}

/// The quick scene with [units], and with the numbers that are implied without them.
inline std::string quick_scene_with_units(const std::string& units, const std::string& end_time = "3.0") {
  const std::string scene =
      std::regex_replace(quick_scene(end_time), std::regex("\nconductance"), "\ncapacitance = 1.0\nconductance");
  return "[units]\n" + units + "[fluid]\nviscosity = 1.0\n" +
         std::regex_replace(scene, std::regex("\nfield"), "\npermittivity = 1.0\nfield");
}

/// A scene of docs/scenes at a low degree and with few steps. A scene in SI units keeps its steps and ends after a
/// hundredth of its time.
inline std::string shortened_scene(std::string scene) {
  scene = std::regex_replace(scene, std::regex("\n(degree|order) = \\d+"), "\n$1 = 6");
  std::smatch end;
  if (std::regex_search(scene, end, std::regex("\nend_time = \"([0-9.]+) (\\w+)\""))) {
    const double time = 0.01 * std::stod(end[1]);
    const auto line = [unit = end[2].str()](const char* key, double value) {
      return fmt::format("\n{} = \"{} {}\"", key, value, unit);
    };
    scene = std::regex_replace(scene, std::regex("\nend_time = .*"), line("end_time", time));
    return std::regex_replace(scene, std::regex("\nevery = .*"), line("every", 0.5 * time));
  }
  scene = std::regex_replace(scene, std::regex("\ndt = [0-9.e-]+"), "\ndt = 0.1");
  scene = std::regex_replace(scene, std::regex("\nend_time = [0-9.e-]+"), "\nend_time = 0.3");
  return std::regex_replace(scene, std::regex("\nevery = [0-9.e-]+"), "\nevery = 0.1");
}

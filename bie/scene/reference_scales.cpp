#include "bie/scene/reference_scales.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "bie/scene/reference_time.hpp"
#include "bie/scene/si_values.hpp"
#include "bie/scene/units.hpp"

namespace vehd {

void derive_reference_scales(UnitsScene& units, const toml::table& file, const std::string& name) {
  const UnitsScene given = units;
  const SiValues si(file, name, given);
  if (const auto area = si.size("shape", "area"); area && !units.length) {
    units.length = std::sqrt(*area / (4.0 * std::numbers::pi));
  }
  if (!units.viscosity) units.viscosity = si.size("fluid", "viscosity");
  if (!units.time) units.time = shortest_time(si, units);
  if (!units.length || !units.viscosity || !units.time) return;
  if (const auto capacitance = si.size("membrane", "capacitance"); capacitance && !units.potential) {
    const double potential = std::sqrt(*units.viscosity * *units.length / (*units.time * *capacitance));
    if (has_magnitude_in_range(potential)) units.potential = potential;
  }
}

std::string source_of_scale(std::string_view scale) {
  if (scale == "length") return "\"area\" in [shape]";
  if (scale == "viscosity") return "\"viscosity\" in [fluid]";
  if (scale == "potential") return "\"capacitance\" in [membrane]";
  return "a value that sets a time, such as \"duration\" of a pulse, \"rate\" in [flow] or \"bending_modulus\" in "
         "[membrane]";
}

}  // namespace vehd

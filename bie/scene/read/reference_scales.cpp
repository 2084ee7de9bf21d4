#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

constexpr double absent = std::numeric_limits<double>::quiet_NaN();

/// Values of a scene file in SI base units. An absent value is NaN, and so is everything computed from it.
class SiValues {
 public:
  /// @param units  the scales that [units] gives
  SiValues(const TomlFile& file, const UnitsScene& units) : file_(file), units_(units) {}

  /// Magnitude of a number, length of a vector or of the longest row of a matrix.
  /// @return NaN also if it is zero, or if a component other than zero has no unit
  [[nodiscard]] double operator()(std::string_view table, std::string_view key) const {
    const KeyDescription* description = find_key(table, key);
    const toml::node* node = file_.table.at_path(table)[key].node();
    if (description == nullptr || node == nullptr) return absent;
    const double size = size_of(*node, *description);
    return size > 0.0 ? size : absent;
  }

 private:
  [[nodiscard]] double size_of(const toml::node& node, const KeyDescription& key) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || key.type == ValueType::number) {
      const auto si = si_number(key, node, file_.name, units_);
      // A plain zero is valid in every unit.
      return std::abs(si.value_or(number_of(node) == 0.0 ? 0.0 : absent));
    }
    double length = 0.0, largest_row = 0.0;
    for (const toml::node& entry : *array) {
      const double size = size_of(entry, key);
      if (std::isnan(size)) return absent;
      if (entry.is_array()) {
        largest_row = std::max(largest_row, size);
      } else {
        length = std::hypot(length, size);
      }
    }
    return std::max(length, largest_row);
  }

  const TomlFile& file_;
  const std::optional<UnitsScene> units_;
};

std::optional<double> given(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

/// Shortest time of the scene, in s; nullopt if it gives none.
/// @param units  with the reference length and viscosity
std::optional<double> shortest_time(const SiValues& si, const UnitsScene& units, const TomlFile& file) {
  const double length = units.length.value_or(absent), viscosity = units.viscosity.value_or(absent);
  double shortest = absent;
  const auto consider = [&](double time) {
    // A product or quotient of values may be out of range.
    if (time > 0.0 && has_magnitude_in_range(time)) shortest = std::fmin(shortest, time);
  };
  for (const std::string_view table : {"flow.waveform", "electric.waveform"}) {
    consider(si(table, "duration"));
    consider(si(table, "period"));
    if (!file.table.at_path(table)["average"].value_or(false)) consider(1.0 / si(table, "frequency"));
  }
  consider(1.0 / si("flow", "rate"));
  consider(1.0 / si("flow", "gradient"));
  consider(si("flow", "radius") * (1.0 / si("flow", "centre_velocity")));
  if (file.find("electric") != nullptr) {
    const double inside = si("electric", "conductivity_in"), outside = si("electric", "conductivity_out");
    consider(length * si("membrane", "capacitance") * (1.0 / inside + 0.5 / outside));
    const bool has_magnitude = file.table.at_path("electric.field_magnitude").node() != nullptr;
    const double field = 1.0 / si("electric", has_magnitude ? "field_magnitude" : "field");
    consider(viscosity * (1.0 / si("electric", "permittivity")) * field * field);
  }
  consider(viscosity * length * length * length * (1.0 / si("membrane", "bending_modulus")));
  return given(shortest);
}

}  // namespace

void derive_reference_scales(UnitsScene& units, const TomlFile& file) {
  const SiValues si(file, units);
  const double area = si("shape", "area");
  if (!units.length) units.length = given(std::sqrt(area / (4.0 * std::numbers::pi)));
  if (!units.viscosity) units.viscosity = given(si("fluid", "viscosity"));
  if (!units.time) units.time = shortest_time(si, units, file);
  if (!units.length || !units.viscosity || !units.time) return;
  const double capacitance = si("membrane", "capacitance");
  const double potential = std::sqrt(*units.viscosity * *units.length / (*units.time * capacitance));
  if (!units.potential && has_magnitude_in_range(potential)) units.potential = potential;
}

std::string source_of_scale(std::string_view scale) {
  if (scale == "length") return "\"area\" in [shape]";
  if (scale == "viscosity") return "\"viscosity\" in [fluid]";
  if (scale == "potential") return "\"capacitance\" in [membrane]";
  return "a value that sets a time, such as \"duration\" of a pulse, \"rate\" in [flow] or \"bending_modulus\" in "
         "[membrane]";
}

}  // namespace vehd

#include "bie/scene/reference_scales.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "bie/scene/schema.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

struct Source {
  std::string_view scale, table, key;
};

constexpr std::array<Source, 4> sources = {{{"length", "shape", "area"},
                                            {"viscosity", "fluid", "viscosity"},
                                            {"time", "membrane", "bending_modulus"},
                                            {"potential", "membrane", "capacitance"}}};

const Source& source(std::string_view scale) {
  return *std::find_if(sources.begin(), sources.end(), [&](const Source& entry) { return entry.scale == scale; });
}

/// Size of the SI value behind a scale; nullopt if there is none of use. What is wrong with it is said when the key
/// itself is read.
std::optional<double> size_in_si(std::string_view scale, const toml::table& file) {
  const auto& [name, table, key] = source(scale);
  const auto text = file[table][key].value<std::string_view>();
  const auto quantity = text ? parse_quantity(*text) : std::nullopt;
  const Unit* unit = quantity ? find_dimension(find_key(table, key)->unit)->find(quantity->unit) : nullptr;
  if (unit == nullptr || quantity->number == 0.0) return std::nullopt;
  return std::abs(quantity->in_si(*unit));
}

}  // namespace

void derive_reference_scales(UnitsScene& units, const toml::table& file) {
  if (const auto area = size_in_si("length", file); area && !units.length) {
    units.length = std::sqrt(*area / (4.0 * std::numbers::pi));
  }
  if (const auto viscosity = size_in_si("viscosity", file); viscosity && !units.viscosity) {
    units.viscosity = viscosity;
  }
  if (!units.length || !units.viscosity) return;
  if (const auto modulus = size_in_si("time", file); modulus && !units.time) {
    units.time = *units.viscosity * std::pow(*units.length, 3) / *modulus;
  }
  if (!units.time) return;
  if (const auto capacitance = size_in_si("potential", file); capacitance && !units.potential) {
    units.potential = std::sqrt(*units.viscosity * *units.length / (*units.time * *capacitance));
  }
}

std::string source_of_scale(std::string_view scale) {
  return fmt::format("\"{}\" in [{}]", source(scale).key, source(scale).table);
}

}  // namespace vehd

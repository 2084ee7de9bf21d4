#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "bie/scene/scene.hpp"

/// Units in which results are shown: history.csv, summary.json, pictures, progress.
namespace vehd {

/// One unit for the numbers of a scene.
struct OutputUnit {
  std::string symbol;   ///< in ASCII as in a scene, "um^2"; empty if numbers stay dimensionless
  double factor = 1.0;  ///< from a number of the scene to one in this unit

  /// Does it show SI values?
  [[nodiscard]] bool is_si() const { return !symbol.empty(); }
  /// A number of the scene followed by the unit: "2.5 ms", or "2.5" without one.
  [[nodiscard]] std::string text_of(double number) const;
};

/// The unit of every dimension. By default all numbers are shown as they are.
class OutputUnits {
 public:
  OutputUnits() = default;
  /// The units that [output] of the scene requests; SI units are the same for every scene (docs/run_files.md). A
  /// dimension without a reference scale in the scene stays dimensionless.
  explicit OutputUnits(const Scene& scene);
  /// The units of an existing run, with any prefixes.
  /// @param symbols  unit of each dimension by its name; other dimensions are dimensionless
  OutputUnits(std::optional<UnitsScene> scales, std::map<std::string, std::string, std::less<>> symbols);

  /// @param dimension  by its name (units.hpp); pure numbers have no unit
  [[nodiscard]] OutputUnit of(std::string_view dimension) const;

 private:
  std::optional<UnitsScene> scales_;
  std::map<std::string, std::string, std::less<>> symbols_;
};

/// A number in SI base units with a suitable prefix: "12 ms" for 0.012 and "time".
/// @param dimension  of results: see OutputUnits
std::string si_number(double value, std::string_view dimension, int digits = 4);

/// A number of a scene with the SI unit of its dimension, or the plain number if the scene has no scale for it.
std::string quantity_text(const std::optional<UnitsScene>& units, double value, std::string_view dimension);

/// A symbol as in print: "µm²" for "um^2".
std::string printed_unit(std::string_view symbol);

/// A label of an axis or a colour bar: "time (ms)" for "time" and "ms", "time" without a unit.
std::string with_unit(std::string_view label, std::string_view symbol);

}  // namespace vehd

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bie/files/run_reader.hpp"
#include "bie/files/si_unit.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {

/// Converts times of a run from and to text: "0.5 ms", or a number in the unit that the header of its history names.
/// Without a history beside the run, plain numbers are accepted only if the scene has no unit of time.
class GivenTimes {
 public:
  /// @param file  from which `run` was read
  /// @throws InputError if its scene cannot be read
  GivenTimes(const RunReader& run, const std::filesystem::path& file);

  /// The time as a number of the scene. @throws InputError
  [[nodiscard]] double number_of(const std::string& text) const;
  /// The unit in which times are shown.
  [[nodiscard]] SiUnit shown() const;

 private:
  std::string file_;
  std::optional<UnitsScene> scales_;
  std::optional<OutputUnit> unit_;  ///< absent: unknown
};

}  // namespace vehd

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bie/files/run_reader.hpp"
#include "bie/files/si_unit.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {

/// Times of a run as people write and read them: "0.5 ms", or a number in the unit that the header of its history
/// names. Where there is no history beside the run, numbers count only if the scene has no unit of time.
class GivenTimes {
 public:
  /// @param file  that `run` was read from
  /// @throws InputError if its scene cannot be read
  GivenTimes(const RunReader& run, const std::filesystem::path& file);

  /// As a number of the scene. @throws InputError
  [[nodiscard]] double number_of(const std::string& text) const;
  /// The unit in which times are shown.
  [[nodiscard]] SiUnit shown() const;

 private:
  std::string file_;
  std::optional<UnitsScene> scales_;
  std::optional<OutputUnit> unit_;  ///< absent: not known
};

}  // namespace vehd

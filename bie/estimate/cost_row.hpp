#pragma once

#include <cstdint>
#include <string>

namespace vehd {

/// What one accuracy costs.
struct CostRow {
  double tolerance = 0.0;
  int order = 0;              ///< highest degree that the run takes
  std::int64_t steps = 0;     ///< accepted ones
  double seconds = 0.0;       ///< of `vehd run`, without pictures
  double file_seconds = 0.0;  ///< of these, what its files take
  std::int64_t memory_bytes = 0;
  bool measured = false;  ///< degree and steps are those of a whole run
  /// Why a run with this tolerance cannot take its steps: it was tried. Empty if it can; nothing else is known then.
  std::string stops{};
  /// Why nothing is known: there was no time to run it, and no looser one says what it costs. Empty otherwise.
  std::string unknown{};
};

}  // namespace vehd

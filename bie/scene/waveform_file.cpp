#include "bie/scene/waveform_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// A waveform of more rows is some other file.
constexpr std::size_t most_rows = 1000000;

}  // namespace

void read_waveform_table(WaveformScene& waveform, const std::filesystem::path& folder) {
  if (!waveform.path) return;
  const std::filesystem::path path = std::filesystem::absolute(folder / *waveform.path).lexically_normal();
  if (!waveform.times.empty() || !waveform.values.empty()) {
    throw InputError(
        fmt::format("{}: the waveform has \"path\" together with \"times\" or \"values\"; accepted: one "
                    "of them",
                    path.string()));
  }
  std::error_code error;
  std::ifstream file(path);
  if (!std::filesystem::is_regular_file(path, error) || !file) {
    throw InputError(fmt::format("{}: no such file (\"path\" of a waveform)", path.string()));
  }
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    line.erase(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream words(line);
    double time = 0.0, value = 0.0;
    std::string more;
    if (!(words >> time >> value) || words >> more || !std::isfinite(time) || !std::isfinite(value)) {
      throw InputError(fmt::format("{}:{}: accepted: two numbers, time and factor", path.string(), number));
    }
    if (waveform.times.size() == most_rows) {
      throw InputError(fmt::format("{}:{}: more than {} rows", path.string(), number, most_rows));
    }
    waveform.times.push_back(time);
    waveform.values.push_back(value);
  }
  waveform.path.reset();
}

}  // namespace vehd

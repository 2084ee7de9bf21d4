#include "bie/scene/waveform_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// A waveform of more rows or bytes is some other file. The rows become part of the effective scene, which every
/// checkpoint holds and which must not be too long for a scene file itself.
constexpr std::size_t most_rows = 10000;
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 22;

}  // namespace

void read_waveform_rows(WaveformScene& waveform, std::istream& stream, const std::string& name) {
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    std::string cells = line.substr(0, line.find('#'));
    std::replace(cells.begin(), cells.end(), ',', ' ');
    if (cells.find_first_not_of(" \t") == std::string::npos) continue;
    std::istringstream words(cells);
    double time = 0.0, value = 0.0;
    std::string more;
    if (!(words >> time >> value) || words >> more || !std::isfinite(time) || !std::isfinite(value)) {
      throw InputError(fmt::format("{}:{}: is \"{}\"; accepted: two finite numbers, time and factor", name, number,
                                   shortened(line)));
    }
    if (waveform.times.size() == most_rows) {
      throw InputError(fmt::format("{}:{}: more than {} rows", name, number, most_rows));
    }
    waveform.times.push_back(time);
    waveform.values.push_back(value);
  }
}

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
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error || bytes > most_bytes) {
    throw InputError(fmt::format("{}: {} bytes are too many for a waveform; accepted: at most {}", path.string(), bytes,
                                 most_bytes));
  }
  read_waveform_rows(waveform, file, path.string());
  waveform.path.reset();
}

}  // namespace vehd

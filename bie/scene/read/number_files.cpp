#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "bie/scene/read/reading_steps.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Most lines of a file of harmonics: one for each harmonic up to the highest degree.
constexpr std::size_t most_modes = 1 + highest_order * (highest_order + 2);
/// A file with more rows or bytes is no waveform. The rows become part of the effective scene, which every checkpoint
/// stores and which must not be too long for a scene file itself.
constexpr std::size_t most_rows = 10000;
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 22;

/// @param read  called with the words of a line without its comment, its place, and the line as written for messages
template <typename Read>
void for_each_row(std::istream& stream, const std::string& name, const Read& read) {
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    std::string cells = line.substr(0, line.find('#'));
    std::replace(cells.begin(), cells.end(), ',', ' ');
    if (cells.find_first_not_of(" \t") == std::string::npos) continue;
    std::istringstream words(cells);
    read(words, fmt::format("{}:{}", name, number), shortened(line));
  }
}

bool is_at_end(std::istringstream& words) {
  std::string more;
  return !(words >> more);
}

void read_modes(VaryingProperty& varying, const std::string& name) {
  std::ifstream file(name);
  for_each_row(file, name, [&](std::istringstream& words, const std::string& place, const std::string& line) {
    HarmonicMode mode;
    const bool is_mode = words >> mode.n >> mode.m >> mode.a && is_at_end(words) && std::isfinite(mode.a);
    if (!is_mode || mode.n < 0 || mode.n > highest_order || std::abs(mode.m) > mode.n ||
        varying.modes.size() == most_modes) {
      throw InputError(
          fmt::format("{}: is \"{}\"; accepted: three numbers n, m, a with |m| <= n <= {}, at most {} lines", place,
                      line, highest_order, most_modes));
    }
    varying.modes.push_back(mode);
  });
}

void read_times(WaveformScene& waveform, const std::string& name) {
  std::ifstream file(name);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(name, error);
  if (error || bytes > most_bytes) {
    throw InputError(
        fmt::format("{}: {} bytes are too many for a waveform; accepted: at most {}", name, bytes, most_bytes));
  }
  read_waveform_rows(waveform, file, name);
}

}  // namespace

void read_waveform_rows(WaveformScene& waveform, std::istream& stream, const std::string& name) {
  for_each_row(stream, name, [&](std::istringstream& words, const std::string& place, const std::string& line) {
    double time = 0.0, value = 0.0;
    if (!(words >> time >> value) || !is_at_end(words) || !std::isfinite(time) || !std::isfinite(value)) {
      throw InputError(fmt::format("{}: is \"{}\"; accepted: two finite numbers, time and factor", place, line));
    }
    if (waveform.times.size() == most_rows) throw InputError(fmt::format("{}: more than {} rows", place, most_rows));
    waveform.times.push_back(time);
    waveform.values.push_back(value);
  });
}

void read_number_files(Scene& scene, const TomlFile& file, const std::filesystem::path& folder) {
  /// @param numbers  keys of the same numbers, and whether the table has any of them
  const auto replace = [&](auto& owner, const std::string& table, const char* numbers, bool has_numbers,
                           const auto& read) {
    if (!owner.path) return;
    if (has_numbers) {
      file.refuse_key(table, "path", "\"path\" in [{}] together with {}; accepted: one of them", table, numbers);
    }
    const std::string name = std::filesystem::absolute(folder / *owner.path).lexically_normal().string();
    std::error_code error;
    if (!std::filesystem::is_regular_file(name, error) || !std::ifstream(name)) {
      file.refuse_key(table, "path", "\"path\" in [{}] is {}: no such file", table, name);
    }
    read(owner, name);
    owner.path.reset();
  };
  const auto replace_modes = [&](auto& owner, const std::string& table) {
    if (owner) replace(*owner, "membrane." + table, "\"modes\"", !owner->modes.empty(), read_modes);
  };
  const auto replace_waveform = [&](auto& owner, const std::string& table) {
    if (!owner || !owner->waveform) return;
    WaveformScene& waveform = *owner->waveform;
    replace(waveform, table + ".waveform", "\"times\" or \"values\"",
            !waveform.times.empty() || !waveform.values.empty(), read_times);
  };
  MembraneScene& membrane = scene.membrane;
  replace_modes(membrane.varying_capacitance, "varying_capacitance");
  replace_modes(membrane.varying_conductance, "varying_conductance");
  replace_modes(membrane.varying_bending, "varying_bending");
  replace_modes(membrane.varying_curvature, "varying_curvature");
  replace_modes(membrane.pump, "pump");
  replace_waveform(membrane.pump, "membrane.pump");
  replace_waveform(scene.flow, "flow");
  replace_waveform(scene.electric, "electric");
}

}  // namespace vehd

#pragma once

#include <array>
#include <string>
#include <string_view>

/// Functions that the fuzzers feed with bytes. Each returns after accepting or refusing them with the program's own
/// InputError; any other error, and every result that contradicts itself, leaves as another exception.
namespace fuzz {

/// A scene file. If it is accepted, it must hold the numbers that are written in it; the effective scene written from
/// it must be read back unchanged, with the same numbers; and `vehd plan` must come to an end.
void scene(std::string_view bytes);

/// The text files beside a scene: the table of a waveform, and a history.csv.
void tables(std::string_view bytes);

/// A run.h5 and a checkpoint as they are on disk.
void files(std::string_view bytes);

/// The bytes are edits of a good run.h5 or checkpoint, made by the HDF5 library: objects that are missing, of other
/// sizes, kinds or values, with checksums that are right.
void edits(std::string_view bytes);

struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
};

constexpr std::array<Target, 4> targets = {{{"scene", scene}, {"tables", tables}, {"files", files}, {"edits", edits}}};

}  // namespace fuzz

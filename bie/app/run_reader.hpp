#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/scene/hdf5_reader.hpp"

namespace vehd {

/// Access to the snapshots of a run.h5. @throws InputError
class RunReader {
 public:
  explicit RunReader(const std::filesystem::path& path);

  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  /// Number of the snapshot whose time is nearest.
  [[nodiscard]] std::size_t nearest(double time) const;
  /// Number of the snapshot at this time, up to the rounding of decimal numbers. @throws InputError if there is none
  [[nodiscard]] std::size_t at(double time) const;
  /// The effective scene of the run.
  [[nodiscard]] std::string scene() const { return file_.text("/scene"); }
  [[nodiscard]] bool has_field(std::size_t snapshot, const std::string& name) const;
  /// Harmonic coefficients, [n_coefficients x components].
  [[nodiscard]] Matrix coefficients(std::size_t snapshot, const std::string& name) const;
  /// The same, of the stated number of components and of the order of x.
  [[nodiscard]] Matrix coefficients(std::size_t snapshot, const std::string& name, Index components) const;

 private:
  [[nodiscard]] std::string path_of(std::size_t snapshot, const std::string& name) const;

  Hdf5Reader file_;
  std::vector<std::string> names_;
  std::vector<double> times_;
};

}  // namespace vehd

#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

#include "bie/scene/scene.hpp"

namespace vehd {

/// The values of a scene file that have an SI unit, before the file is read as a scene.
class SiValues {
 public:
  /// @param name   of the file
  /// @param units  those that [units] gives
  SiValues(const toml::table& file, const std::string& name, const UnitsScene& units)
      : file_(file), name_(name), units_(units) {}

  /// Whether the file has this table.
  [[nodiscard]] bool has_table(std::string_view table) const;
  /// Whether the file says true there.
  [[nodiscard]] bool is_true(std::string_view table, std::string_view key) const;
  /// Magnitude of a number, length of a vector or of the longest row of a matrix, in SI base units.
  /// @return nullopt if it is absent, zero, or has a part other than zero without a unit
  /// @throws InputError where the key is to be refused as it stands: other keys would be blamed for a scale that it
  /// does not give
  [[nodiscard]] std::optional<double> size(std::string_view table, std::string_view key) const;

 private:
  const toml::table& file_;
  const std::string& name_;
  const UnitsScene& units_;
};

}  // namespace vehd

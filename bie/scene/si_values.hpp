#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string_view>

namespace vehd {

/// The values of a scene file that have an SI unit, before the file is read as a scene. What is wrong with a value is
/// said when its key is read; here it only is of no use.
class SiValues {
 public:
  /// @param temperature  in K, of energies in kBT
  explicit SiValues(const toml::table& file, std::optional<double> temperature = std::nullopt)
      : file_(file), temperature_(temperature) {}

  /// Whether the file has this table.
  [[nodiscard]] bool has_table(std::string_view table) const;
  /// Whether the file says true there.
  [[nodiscard]] bool is_true(std::string_view table, std::string_view key) const;
  /// Magnitude of a number, length of a vector or of the longest row of a matrix, in SI base units.
  /// @return nullopt if it is absent, zero, or has a part other than zero without a unit
  [[nodiscard]] std::optional<double> size(std::string_view table, std::string_view key) const;

 private:
  const toml::table& file_;
  std::optional<double> temperature_;
};

}  // namespace vehd

#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bie/scene/schema.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/errors.hpp"

/// TOML files, and the conversion of their nodes to values of the key table.
namespace vehd {

/// Unchanged text of a TOML file.
/// @param what  kind of file, for messages: "a scene file"
/// @throws InputError if it is missing, not a regular file or far too long
std::string text_of_toml_file(const std::filesystem::path& path, std::string_view what);

/// "file:line" of a node, or the option --set that gave it.
std::string place(const toml::node& node, const std::string& file);

/// A file of TOML and the name that stands for it in messages.
struct TomlFile {
  toml::table table;
  std::string name;

  /// The table of a dotted name, or nullptr.
  [[nodiscard]] const toml::table* find(std::string_view dotted) const { return table.at_path(dotted).as_table(); }
  /// The node of a key of a table, or of the table if the key is absent.
  [[nodiscard]] const toml::node& node_of(std::string_view dotted, std::string_view key) const;
  /// A value as typed, such as 0.5 ms; `otherwise` if it is absent.
  /// @param path  as "output.times[2]"
  [[nodiscard]] std::string typed(std::string_view path, const std::string& otherwise = {}) const;

  /// @throws InputError "file:line: problem"
  template <typename... Arguments>
  [[noreturn]] void refuse(const toml::node& node, fmt::format_string<Arguments...> problem,
                           Arguments&&... arguments) const {
    throw InputError(place(node, name) + ": " + fmt::format(problem, std::forward<Arguments>(arguments)...));
  }
  /// Throws InputError with the place of the key of a table, or of the table if the key is absent.
  /// @param dotted  name of a table that exists, such as "electric.waveform"
  template <typename... Arguments>
  [[noreturn]] void refuse_key(std::string_view dotted, std::string_view key, fmt::format_string<Arguments...> problem,
                               Arguments&&... arguments) const {
    refuse(node_of(dotted, key), problem, std::forward<Arguments>(arguments)...);
  }
};

/// A table of a file and what messages call it, such as "[[experiment]]". Its functions throw InputError
/// "file:line: problem"; `accepted` says there what a value may be.
struct NamedTable {
  const TomlFile& file;
  const toml::table& entries;
  std::string name;

  /// Throws "file:line: name problem".
  template <typename... Arguments>
  [[noreturn]] void refuse(const toml::node& node, fmt::format_string<Arguments...> problem,
                           Arguments&&... arguments) const {
    file.refuse(node, "{} {}", name, fmt::format(problem, std::forward<Arguments>(arguments)...));
  }
  /// Throws with the value of a key; `rest` follows it in the message.
  [[noreturn]] void refuse_value(std::string_view key, std::string_view rest) const;
  void require_words(const std::vector<std::string_view>& words) const;
  /// Value of a key that must be present.
  [[nodiscard]] const toml::node& at(std::string_view key, std::string_view accepted) const;
  /// A text that is not empty.
  [[nodiscard]] std::string text(std::string_view key, std::string_view accepted) const;
  /// Path of a file that exists, relative to a folder.
  [[nodiscard]] std::filesystem::path path(std::string_view key, std::string_view accepted,
                                           const std::filesystem::path& folder) const;
  /// A number, or one with a unit.
  [[nodiscard]] Quantity quantity(std::string_view key, std::string_view accepted) const;
  /// One of these words, the first if the key is absent.
  [[nodiscard]] std::string word(std::string_view key, const std::vector<std::string_view>& words) const;
};

/// Visits the keys of a scene that a table lists with a table for each. They may also be written without quotes, as
/// nested tables: flow.rate = {...}.
/// @throws InputError if there are none, or if one has no table or two
void for_each_key(const TomlFile& file, const std::string& table, std::string_view accepted,
                  const std::function<void(const std::string& key, const NamedTable& values)>& visit);

/// @param name  stands for the file in messages
/// @throws InputError "name:line: ..."
TomlFile parse_toml(const std::string& text, const std::string& name);

/// Value of a floating-point number or of an integer, which becomes the nearest double.
/// @return nullopt if the node is no number
std::optional<double> number_of(const toml::node& node);

/// The value as written, cut to a readable length, with its type if that is not obvious.
std::string shown(const toml::node& node);

/// SI value of a number with a unit, within the range of its key.
/// @return nullopt for a plain number
/// @throws InputError for anything else, as checked_value does
std::optional<double> si_number(const KeyDescription& key, const toml::node& node, const std::string& file,
                                const std::optional<UnitsScene>& units);

/// Value of the key's type within its range, dimensionless unless it is a quantity.
/// @param units  reference scales, with which a number may also be a text with an SI unit
/// @throws InputError naming place, value and what is accepted
Value checked_value(const KeyDescription& key, const toml::node& node, const std::string& file,
                    const std::optional<UnitsScene>& units);

}  // namespace vehd

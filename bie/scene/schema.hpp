#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bie/scene/scene.hpp"

/// The one table of scene keys (key_rows.cpp). The reader, the writer, the comparison of two scenes and the reference
/// text are all driven by it, so that a key is described in exactly one place; defaults are those of the structs in
/// scene.hpp.
namespace vehd {

/// Value of a key of any type.
using Value = std::variant<bool, std::int64_t, double, std::string, Triple, TripleOfTriples, AxisAngle,
                           std::vector<double>, std::vector<HarmonicMode>, std::vector<OutputWindow>>;

/// The alternatives of a Value in their order, and two that are stored in one of them: a word is one of several texts,
/// a quantity is a number that always has a unit, stored in SI. Every other number is dimensionless once read.
enum class ValueType {
  boolean,
  integer,
  number,
  text,
  triple,
  matrix,
  axis_angle,
  numbers,
  modes,
  windows,
  word,
  quantity
};

/// Accepted interval of a number or of every component of an array.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_excluded = false;

  /// Is the value in the interval?
  [[nodiscard]] bool contains(double value) const;
  /// "> 0", ">= 0", "4 ... 64", "> 0 and <= 1" or "any finite number"
  [[nodiscard]] std::string text() const;
};

/// The smallest value of "tolerance".
constexpr double tightest_tolerance = 1e-9;
/// Sizes in any unit of length: their cubes, and products of these, stay far from the limits of a double.
constexpr Range size_range{1e-30, 1e30, false};

/// One key of a scene: names, accepted values and access to its value.
struct KeyDescription {
  std::string_view table;
  std::string_view name;
  std::string_view other_name;  ///< also accepted on reading; empty if it has none
  ValueType type = ValueType::number;
  Value stored_as;          ///< any value of the type in which its values are stored
  std::string_view symbol;  ///< as in the paper; empty if it has none
  std::string_view unit;    ///< name of a dimension (units.hpp), "1", or empty if the value is not a number
  Range range;
  std::vector<std::string_view> words;  ///< accepted values of a word
  std::vector<std::string_view> kinds;  ///< the key belongs to these kinds of its table only; empty: to all
  bool required = false;                ///< see also needs_value
  std::function<bool(const Scene&)> default_has_effect;  ///< empty: in every scene that has the key
  std::string_view description;
  std::function<std::optional<Value>(const Scene&)> get;  ///< nullopt: the optional value is absent
  std::function<void(Scene&, const Value&)> set;

  /// Is this one of its names?
  [[nodiscard]] bool is_called(std::string_view word) const;
  /// Is the number in the range, and 0 or within the accepted magnitudes (units.hpp)? Times have no upper limit of
  /// magnitude, because they are compared and not multiplied with each other.
  [[nodiscard]] bool accepts(double value) const;
  /// Does the key belong to this kind of its table?
  [[nodiscard]] bool is_for(std::string_view kind) const;
  /// Name of its type.
  [[nodiscard]] std::string_view type_text() const;
  /// Accepted values, in words.
  [[nodiscard]] std::string accepted_text() const;
};

/// One table of a scene.
struct TableDescription {
  std::string_view name;
  std::string_view description;
  bool required = false;
  std::function<bool(const Scene&)> present;
  std::function<void(Scene&)> create;
};

/// All tables, in the order in which they are read and written.
const std::vector<TableDescription>& scene_tables();
/// The keys of all tables, in the order in which they are read and written.
const std::vector<KeyDescription>& scene_keys();

/// Names of the keys of a table, each once.
std::vector<std::string_view> key_names(std::string_view table);

/// The table of that name, or nullptr.
const TableDescription* find_table(std::string_view name);

/// Names of the tables that have a key of that name.
std::vector<std::string_view> tables_with(std::string_view key);

/// The first row of the key with either name, or nullptr. A key may have different rows for different kinds.
const KeyDescription* find_key(std::string_view table, std::string_view name);

/// The row of the key that applies to the kind, or nullptr.
const KeyDescription* find_key_of_kind(std::string_view table, std::string_view name, std::string_view kind);

/// The key whose value is the kind of a table, "kind" or the "model" of an effect; nullptr for tables without kinds.
const KeyDescription* kind_key(std::string_view table);

/// Value of kind_key; empty for tables without kinds.
std::string kind_of(const Scene& scene, std::string_view table);

/// Whether the key applies to this scene: its table is present and of the key's kind.
bool applies(const KeyDescription& key, const Scene& scene);

/// Value of a key that is left out of a table that is present; nullopt: absent.
std::optional<Value> default_value(const KeyDescription& key);

/// Does the meaning of the default depend on [units]? True for every key with a dimension whose default is neither 0
/// nor absent.
bool has_default_in_units(const KeyDescription& key);

/// Whether the scene, which has the key, must give its value: if it is required or, with [units], if its default
/// depends on the units and has an effect.
bool needs_value(const KeyDescription& key, const Scene& scene);

/// "table.key" of every value in which the scenes differ, "vesicle[0].table.key" for one of several vesicles; only
/// "vesicle.name" if the names of the vesicles differ.
std::vector<std::string> differing_keys(const Scene& a, const Scene& b);

/// A value as TOML, numbers with the digits that reading them back exactly needs.
std::string to_toml(const Value& value);

/// The value of a key as TOML; a quantity in its SI unit.
std::string to_toml(const KeyDescription& key, const Value& value);

}  // namespace vehd

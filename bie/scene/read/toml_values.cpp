#include "bie/scene/read/toml_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "bie/scene/nearest_name.hpp"
#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/settings.hpp"

namespace vehd {
namespace {

/// Reads values of one key of one file; read() is overloaded by the type of the value.
class ValueReader {
 public:
  ValueReader(const KeyDescription& key, const std::string& file, const std::optional<UnitsScene>& units)
      : key_(key), file_(file), units_(units) {}

  [[noreturn]] void refuse(const toml::node& node) const { refuse(node, fmt::format("is {}", shown(node))); }
  [[noreturn]] void refuse(const toml::node& node, const std::string& problem) const {
    refuse(node, problem, key_.accepted_text());
  }
  [[noreturn]] void refuse(const toml::node& node, const std::string& problem, const std::string& accepted) const {
    refuse_with(node, fmt::format("\"{}\" in [{}] {}; accepted: {}", key_.name, key_.table, problem, accepted));
  }

  /// See si_number.
  [[nodiscard]] std::optional<double> in_si(const toml::node& node) const {
    const toml::value<std::string>* text = node.as_string();
    if (text == nullptr && number_of(node)) return std::nullopt;
    if (text == nullptr) refuse(node);
    const double value = si_value(*find_dimension(key_.unit), *text);
    if (!key_.accepts(value)) refuse_value(node, value);
    return value;
  }

  void read(const toml::node& node, bool& value) const { value = as<bool>(node); }
  void read(const toml::node& node, std::int64_t& value) const {
    value = as<std::int64_t>(node);
    double in_range = 0.0;
    read(node, in_range);
  }
  void read(const toml::node& node, double& value) const {
    if (key_.type == ValueType::quantity) {
      const auto quantity = in_si(node);
      if (!quantity) refuse(node);
      value = *quantity;
      return;
    }
    const toml::value<std::string>* text = node.as_string();
    const std::optional<double> number = text != nullptr ? value_with_unit(*text) : number_of(node);
    if (!number) refuse(node);
    if (!std::isfinite(*number)) refuse(node, fmt::format("is {}, not a finite number", *number));
    if (!key_.accepts(*number)) refuse_value(node, *number);
    // Turns −0 into 0: 1/0 has a sign.
    value = *number + 0.0;
  }
  void read(const toml::node& node, std::string& value) const {
    value = as<std::string>(node);
    if (key_.type == ValueType::text || std::ranges::find(key_.words, value) != key_.words.end()) return;
    refuse_with(node, fmt::format("\"{}\" in [{}] is {}; {}", key_.name, key_.table, shown(node),
                                  suggestion(value, key_.words)));
  }
  template <typename Entry, std::size_t size>
  void read(const toml::node& node, std::array<Entry, size>& values) const {
    const toml::array& array = as<toml::array>(node);
    if (array.size() != size) refuse(node, fmt::format("has {} components", array.size()));
    for (std::size_t i = 0; i < size; ++i) read(array[i], values[i]);
  }
  template <typename Entry>
  void read(const toml::node& node, std::vector<Entry>& values) const {
    for (const toml::node& entry : as<toml::array>(node)) read(entry, values.emplace_back());
  }
  void read(const toml::node& node, HarmonicMode& mode) const {
    const toml::table& table = entry_of({"n", "m", "a"}, node);
    std::int64_t n = 0, m = 0;
    read(*table.get("n"), n);
    read(*table.get("m"), m);
    // Bounded here so that neither can overflow; the order of the scene bounds n further.
    if (n < 0 || n > 1000) refuse(*table.get("n"), fmt::format("has the degree n = {}", n));
    if (m < -n || m > n) refuse(*table.get("m"), fmt::format("has the mode n = {}, m = {}", n, m));
    mode = {static_cast<int>(n), static_cast<int>(m)};
    read(*table.get("a"), mode.a);
  }
  void read(const toml::node& node, OutputWindow& window) const {
    const toml::table& table = entry_of({"from", "to", "every"}, node);
    read(*table.get("from"), window.from);
    read(*table.get("to"), window.to);
    read(*table.get("every"), window.every);
  }

 private:
  [[noreturn]] void refuse_with(const toml::node& node, const std::string& problem) const {
    throw InputError(fmt::format("{}: {}", place(node, file_), problem));
  }

  /// @param value  as read; a value within the range of the key has the wrong magnitude
  [[noreturn]] void refuse_value(const toml::node& node, double value) const {
    if (!key_.range.contains(value)) refuse(node);
    const std::string magnitude = key_.unit == "time"
                                      ? fmt::format("at least {:g}", smallest_magnitude)
                                      : fmt::format("{:g} ... {:g}", smallest_magnitude, largest_magnitude);
    refuse(node, fmt::format("is {}", shown(node)),
           fmt::format("{}, {} in magnitude unless 0", key_.accepted_text(), magnitude));
  }

  /// The node as one of the types of TOML.
  template <typename Type>
  [[nodiscard]] const Type& as(const toml::node& node) const {
    const auto* value = node.as<Type>();
    if (value == nullptr) refuse(node);
    if constexpr (std::is_same_v<Type, toml::array>) {
      return *value;
    } else {
      return value->get();
    }
  }

  /// An entry of a list of tables with exactly these keys.
  [[nodiscard]] const toml::table& entry_of(std::initializer_list<std::string_view> names,
                                            const toml::node& node) const {
    const toml::table* table = node.as_table();
    if (table == nullptr) refuse(node, fmt::format("has the entry {}", shown(node)));
    for (const auto& [name, value] : *table) {
      if (std::ranges::find(names, name.str()) != names.end()) continue;
      refuse_with(value, fmt::format("unknown key \"{}\" in an entry of \"{}\" in [{}]; accepted: {}", name.str(),
                                     key_.name, key_.table, fmt::join(names, ", ")));
    }
    for (const std::string_view name : names) {
      if (!table->contains(name)) refuse(node, fmt::format("has an entry without \"{}\"", name));
    }
    return *table;
  }

  /// SI value of a text such as "1 kV/cm".
  [[nodiscard]] double si_value(const Dimension& dimension, const toml::value<std::string>& node) const {
    const auto quantity = parse_quantity(node.get());
    if (!quantity) refuse(node);
    if (quantity->unit.empty()) refuse(node, fmt::format("is {}, without a unit", shown(node)), dimension.accepted());
    const Unit* unit = dimension.find(quantity->unit);
    if (unit == nullptr) {
      refuse(
          node,
          fmt::format("is {}, whose unit \"{}\" is none of {} (nearest: \"{}\")", shown(node),
                      shortened(quantity->written), dimension.name, nearest_name(quantity->unit, dimension.symbols())),
          dimension.accepted());
    }
    const std::optional<double> temperature = units_ ? units_->temperature : std::nullopt;
    if (unit->per_kelvin && !temperature) {
      refuse(node, fmt::format("is {}, but the scene has no temperature", shown(node)),
             "\"temperature\" in [units] with the unit K");
    }
    return quantity->in_si(*unit, temperature);
  }

  /// Dimensionless value of a text such as "1 kV/cm".
  [[nodiscard]] double value_with_unit(const toml::value<std::string>& node) const {
    const Dimension* dimension = find_dimension(key_.unit);
    if (dimension == nullptr || !parse_quantity(node.get())) refuse(node);
    if (!units_) refuse(node, fmt::format("is {}, but the scene has no table [units]", shown(node)));
    const double value = si_value(*dimension, node);
    const auto scale = reference_scale(*units_, *dimension);
    if (!scale) {
      const std::string_view missing = missing_scale(*units_, *dimension);
      refuse(node, fmt::format("is {}, but the scene has no reference {}", shown(node), missing),
             fmt::format("\"{}\" in [units], or a unit for {}", missing, source_of_scale(missing)));
    }
    if (!std::isnormal(*scale)) {
      refuse(node, fmt::format("is {}, but 1 of the scene is {} {}", shown(node), *scale, dimension->si_unit()),
             "scales in [units] whose powers a number can hold");
    }
    const double result = value / *scale;
    // A value that underflows to 0 would have another meaning.
    if (value != 0.0 && result == 0.0) refuse_value(node, value);
    return result;
  }

  const KeyDescription& key_;
  const std::string& file_;
  const std::optional<UnitsScene>& units_;
};

/// Limits the parts of dotted keys: the parser builds a table for every part, and their destruction recurses.
/// @throws InputError at the first key with too many parts
void require_short_keys(const std::string& text, const std::string& name) {
  constexpr int most_parts = 16;
  int line = 1;
  int dots = 0;
  char quote = '\0', before = '\n';
  for (const char letter : text) {
    if (letter == '\n') {
      ++line;
      dots = 0;
      quote = '\0';
    } else if (quote != '\0') {
      if (letter == quote) quote = '\0';
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '.') {
      // Dots of a comment, such as a line of them, follow no part of a key.
      if (before == '.' || before == '#') continue;
      if (++dots >= most_parts) {
        throw InputError(fmt::format("{}:{}: a key has too many parts; accepted: at most {}", name, line, most_parts));
      }
    } else if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '_' && letter != '-' &&
               letter != ' ' && letter != '\t') {
      dots = 0;
    }
    if (letter != ' ' && letter != '\t') before = letter;
  }
}

void visit_keys(const NamedTable& part, const std::string& prefix, std::string_view accepted,
                const std::function<void(const std::string&, const NamedTable&)>& visit) {
  for (const auto& [word, node] : part.entries) {
    const std::string key = prefix + std::string(word.str());
    const std::string name = fmt::format("\"{}\" in {}", key, part.name);
    const toml::table* table = node.as_table();
    if (table == nullptr) part.file.refuse(node, "{} is {}; accepted: {}", name, shown(node), accepted);
    const bool is_group = !key_names(key).empty() || std::all_of(table->begin(), table->end(), [](const auto& entry) {
      return entry.second.is_table();
    });
    if (is_group && !table->empty()) {
      visit_keys({part.file, *table, part.name}, key + '.', accepted, visit);
    } else {
      visit(key, {part.file, *table, name});
    }
  }
}

}  // namespace

std::string text_of_toml_file(const std::filesystem::path& path, std::string_view what) {
  // No sensible file comes near this size.
  constexpr std::uintmax_t largest_bytes = 1 << 20;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(fmt::format("{}: not a file; {} (TOML) is expected", path.string(), what));
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (size > largest_bytes) {
    throw InputError(fmt::format("{}: {} bytes are too many for {}; accepted: at most {}", path.string(), size, what,
                                 largest_bytes));
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(fmt::format("{}: cannot be read", path.string()));
  return text.str();
}

TomlFile parse_toml(const std::string& text, const std::string& name) {
  require_short_keys(text, name);
  try {
    return {toml::parse(text, name), name};
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
  }
}

std::string place(const toml::node& node, const std::string& file) {
  if (is_from_setting(node)) return *node.source().path;
  return fmt::format("{}:{}", file, node.source().begin.line);
}

const toml::node& TomlFile::node_of(std::string_view dotted, std::string_view key) const {
  const auto owner = table.at_path(dotted);
  const auto node = owner[key];
  return node ? *node.node() : *owner.node();
}

std::string TomlFile::typed(std::string_view path, const std::string& otherwise) const {
  const auto node = table.at_path(path);
  if (!node) return otherwise;
  return node.is_string() ? node.as_string()->get() : shown(*node.node());
}

void NamedTable::refuse_value(std::string_view key, std::string_view rest) const {
  const toml::node& node = *entries.get(key);
  file.refuse(node, "\"{}\" in {} is {}{}", key, name, shown(node), rest);
}

void NamedTable::require_words(const std::vector<std::string_view>& words) const {
  for (const auto& [word, node] : entries) {
    if (std::ranges::find(words, word.str()) != words.end()) continue;
    file.refuse(node, "unknown {} \"{}\" in {}; {}", node.is_table() ? "table" : "key", word.str(), name,
                suggestion(word.str(), words));
  }
}

const toml::node& NamedTable::at(std::string_view key, std::string_view accepted) const {
  const toml::node* node = entries.get(key);
  if (node == nullptr) file.refuse(entries, "missing key \"{}\" in {}; accepted: {}", key, name, accepted);
  return *node;
}

std::string NamedTable::text(std::string_view key, std::string_view accepted) const {
  const std::string text = at(key, accepted).value<std::string>().value_or("");
  if (text.empty()) refuse_value(key, fmt::format("; accepted: {}", accepted));
  return text;
}

std::filesystem::path NamedTable::path(std::string_view key, std::string_view accepted,
                                       const std::filesystem::path& folder) const {
  std::filesystem::path path = (folder / text(key, accepted)).lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) refuse_value(key, ": no such file");
  return path;
}

Quantity NamedTable::quantity(std::string_view key, std::string_view accepted) const {
  const toml::node& node = at(key, accepted);
  const auto number = number_of(node);
  const auto quantity = parse_quantity(number ? fmt::format("{}", *number) : node.value<std::string>().value_or(""));
  if (!quantity) refuse_value(key, fmt::format("; accepted: {}", accepted));
  return *quantity;
}

std::string NamedTable::word(std::string_view key, const std::vector<std::string_view>& words) const {
  const toml::node* node = entries.get(key);
  const auto word = node != nullptr ? node->value<std::string>().value_or("") : std::string(words.front());
  if (std::ranges::find(words, word) == words.end()) {
    refuse_value(key, fmt::format("; accepted: \"{}\"", fmt::join(words, "\", \"")));
  }
  return word;
}

void for_each_key(const TomlFile& file, const std::string& table, std::string_view accepted,
                  const std::function<void(const std::string&, const NamedTable&)>& visit) {
  const toml::table* keys = file.find(table);
  if (keys == nullptr || keys->empty()) {
    throw InputError(fmt::format("{}:1: missing table [{}]; accepted: \"table.key\" = {}", file.name, table, accepted));
  }
  std::map<std::string, std::string> places;
  visit_keys({file, *keys, fmt::format("[{}]", table)}, "", accepted,
             [&](const std::string& key, const NamedTable& values) {
               const auto [first, is_new] = places.try_emplace(key, place(values.entries, file.name));
               if (!is_new) values.refuse(values.entries, "is also at {}; accepted: once", first->second);
               visit(key, values);
             });
}

std::optional<double> number_of(const toml::node& node) {
  if (const auto* value = node.as_floating_point()) return value->get();
  // value<double>() of the library rejects integers beyond 2^53.
  if (const auto* value = node.as_integer()) return static_cast<double>(value->get());
  return std::nullopt;
}

std::string shown(const toml::node& node) {
  std::ostringstream stream;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_table<decltype(value)>) {
      stream << "a table";
    } else if constexpr (toml::is_array<decltype(value)>) {
      stream << "the array " << value;
    } else if constexpr (toml::is_string<decltype(value)>) {
      stream << "the text " << value;
    } else if constexpr (toml::is_floating_point<decltype(value)>) {
      stream << to_toml(Value(value.get()));
    } else {
      stream << value;
    }
  });
  std::string text = stream.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return shortened(text);
}

std::optional<double> si_number(const KeyDescription& key, const toml::node& node, const std::string& file,
                                const std::optional<UnitsScene>& units) {
  return ValueReader(key, file, units).in_si(node);
}

Value checked_value(const KeyDescription& key, const toml::node& node, const std::string& file,
                    const std::optional<UnitsScene>& units) {
  Value value = key.stored_as;
  std::visit([&](auto& stored) { ValueReader(key, file, units).read(node, stored); }, value);
  return value;
}

}  // namespace vehd

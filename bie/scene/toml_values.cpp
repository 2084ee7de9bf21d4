#include "bie/scene/toml_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "bie/scene/nearest_name.hpp"
#include "bie/scene/reference_scales.hpp"
#include "bie/scene/settings.hpp"
#include "bie/scene/toml_text.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// One key of one file: everything that a message about it needs.
struct Context {
  const KeyDescription& key;
  const std::string& file;
  const std::optional<UnitsScene>& units;

  [[noreturn]] void refuse(const toml::node& node, const std::string& problem) const {
    refuse(node, problem, accepted_text(key));
  }
  [[noreturn]] void refuse(const toml::node& node, const std::string& problem, const std::string& accepted) const {
    throw InputError(
        fmt::format("{}: \"{}\" in [{}] {}; accepted: {}", place(node, file), key.name, key.table, problem, accepted));
  }
};

/// @param value  as read; what is in the range of the key has the wrong magnitude
[[noreturn]] void refuse_value(const Context& context, const toml::node& node, double value) {
  const std::string problem = fmt::format("is {}", shown(node));
  if (!context.key.range.contains(value)) context.refuse(node, problem);
  const std::string magnitude = context.key.unit == "time"
                                    ? fmt::format("at least {:g}", smallest_magnitude)
                                    : fmt::format("{:g} ... {:g}", smallest_magnitude, largest_magnitude);
  context.refuse(node, problem, fmt::format("{}, {} in magnitude unless 0", accepted_text(context.key), magnitude));
}

/// SI value of a text such as "1 kV/cm".
double si_value(const Context& context, const Dimension& dimension, const toml::value<std::string>& node) {
  const auto quantity = parse_quantity(node.get());
  if (!quantity) context.refuse(node, fmt::format("is {}", shown(node)));
  if (quantity->unit.empty()) {
    context.refuse(node, fmt::format("is {}, without a unit", shown(node)), dimension.accepted());
  }
  const Unit* unit = dimension.find(quantity->unit);
  if (unit == nullptr) {
    context.refuse(
        node,
        fmt::format("is {}, whose unit \"{}\" is none of {} (nearest: \"{}\")", shown(node),
                    shortened(quantity->written), dimension.name, nearest_name(quantity->unit, dimension.symbols())),
        dimension.accepted());
  }
  const std::optional<double> temperature = context.units ? context.units->temperature : std::nullopt;
  if (unit->per_kelvin && !temperature) {
    context.refuse(node, fmt::format("is {}, but the scene has no temperature", shown(node)),
                   "\"temperature\" in [units] with the unit K");
  }
  return quantity->in_si(*unit, temperature);
}

/// Dimensionless value of a text such as "1 kV/cm".
double value_with_unit(const Context& context, const toml::value<std::string>& node) {
  const Dimension* dimension = find_dimension(context.key.unit);
  if (dimension == nullptr || !parse_quantity(node.get())) {
    context.refuse(node, fmt::format("is {}", shown(node)));
  }
  if (!context.units) {
    context.refuse(node, fmt::format("is {}, but the scene has no table [units]", shown(node)));
  }
  const double value = si_value(context, *dimension, node);
  const auto scale = reference_scale(*context.units, *dimension);
  if (scale && !std::isnormal(*scale)) {
    context.refuse(node, fmt::format("is {}, but 1 of the scene is {} {}", shown(node), *scale, dimension->si_unit()),
                   "scales in [units] whose powers a number can hold");
  }
  if (!scale) {
    const std::string_view missing = missing_scale(*context.units, *dimension);
    context.refuse(node, fmt::format("is {}, but the scene has no reference {}", shown(node), missing),
                   fmt::format("\"{}\" in [units], or a unit for {}", missing, source_of_scale(missing)));
  }
  const double result = value / *scale;
  // What is too small for a number would be 0, which is another statement.
  if (value != 0.0 && result == 0.0) refuse_value(context, node, value);
  return result;
}

/// See si_number.
std::optional<double> number_in_si(const Context& context, const toml::node& node) {
  const toml::value<std::string>* text = node.as_string();
  if (text == nullptr && number_of(node)) return std::nullopt;
  if (text == nullptr) context.refuse(node, fmt::format("is {}", shown(node)));
  const double value = si_value(context, *find_dimension(context.key.unit), *text);
  if (!context.key.takes(value)) refuse_value(context, node, value);
  return value;
}

double quantity(const Context& context, const toml::node& node) {
  const auto value = number_in_si(context, node);
  if (!value) context.refuse(node, fmt::format("is {}", shown(node)));
  return *value;
}

double number(const Context& context, const toml::node& node) {
  const toml::value<std::string>* text = node.as_string();
  const std::optional<double> value = text != nullptr ? value_with_unit(context, *text) : number_of(node);
  if (!value) context.refuse(node, fmt::format("is {}", shown(node)));
  if (!std::isfinite(*value)) context.refuse(node, fmt::format("is {}, not a finite number", *value));
  if (!context.key.takes(*value)) refuse_value(context, node, *value);
  // A negative zero is none: 1/0 has a sign.
  return *value + 0.0;
}

std::int64_t integer(const Context& context, const toml::node& node) {
  const toml::value<std::int64_t>* value = node.as_integer();
  if (value == nullptr) context.refuse(node, fmt::format("is {}", shown(node)));
  number(context, node);
  return value->get();
}

bool boolean(const Context& context, const toml::node& node) {
  const toml::value<bool>* value = node.as_boolean();
  if (value == nullptr) context.refuse(node, fmt::format("is {}", shown(node)));
  return value->get();
}

const toml::array& array_of(std::size_t size, const Context& context, const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr) context.refuse(node, fmt::format("is {}", shown(node)));
  if (array->size() != size) context.refuse(node, fmt::format("has {} components", array->size()));
  return *array;
}

Triple triple(const Context& context, const toml::node& node) {
  const toml::array& array = array_of(3, context, node);
  return {number(context, array[0]), number(context, array[1]), number(context, array[2])};
}

TripleOfTriples matrix(const Context& context, const toml::node& node) {
  const toml::array& rows = array_of(3, context, node);
  return {triple(context, rows[0]), triple(context, rows[1]), triple(context, rows[2])};
}

AxisAngle axis_angle(const Context& context, const toml::node& node) {
  const toml::array& array = array_of(4, context, node);
  return {number(context, array[0]), number(context, array[1]), number(context, array[2]), number(context, array[3])};
}

/// @param read  one entry
template <typename Entry>
std::vector<Entry> list_of(Entry (*read)(const Context&, const toml::node&), const Context& context,
                           const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr) context.refuse(node, fmt::format("is {}", shown(node)));
  std::vector<Entry> result;
  for (const toml::node& entry : *array) result.push_back(read(context, entry));
  return result;
}

std::vector<double> numbers(const Context& context, const toml::node& node) {
  return list_of<double>(number, context, node);
}

std::string text(const Context& context, const toml::node& node) {
  const toml::value<std::string>* value = node.as_string();
  if (value == nullptr) context.refuse(node, fmt::format("is {}", shown(node)));
  return value->get();
}

std::string word(const Context& context, const toml::node& node) {
  const std::string value = text(context, node);
  const auto& words = context.key.words;
  if (std::find(words.begin(), words.end(), value) == words.end()) {
    throw InputError(fmt::format("{}: \"{}\" in [{}] is {}; {}", place(node, context.file), context.key.name,
                                 context.key.table, shown(node), suggestion(value, words)));
  }
  return value;
}

/// An entry of a list of tables with exactly these keys.
const toml::table& entry_of(std::initializer_list<std::string_view> names, const Context& context,
                            const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) context.refuse(node, fmt::format("has the entry {}", shown(node)));
  for (const auto& [name, value] : *table) {
    if (std::find(names.begin(), names.end(), name.str()) == names.end()) {
      throw InputError(fmt::format("{}: unknown key \"{}\" in an entry of \"{}\" in [{}]; accepted: {}",
                                   place(value, context.file), name.str(), context.key.name, context.key.table,
                                   fmt::join(names, ", ")));
    }
  }
  for (const std::string_view name : names) {
    if (!table->contains(name)) context.refuse(node, fmt::format("has an entry without \"{}\"", name));
  }
  return *table;
}

HarmonicMode mode(const Context& context, const toml::node& node) {
  const toml::table& table = entry_of({"n", "m", "a"}, context, node);
  const std::int64_t n = integer(context, *table.get("n"));
  const std::int64_t m = integer(context, *table.get("m"));
  // Bounded here so that neither can overflow; the order of the scene bounds n further.
  if (n < 0 || n > 1000) context.refuse(*table.get("n"), fmt::format("has the degree n = {}", n));
  if (m < -n || m > n) context.refuse(*table.get("m"), fmt::format("has the mode n = {}, m = {}", n, m));
  return {static_cast<int>(n), static_cast<int>(m), number(context, *table.get("a"))};
}

std::vector<HarmonicMode> modes(const Context& context, const toml::node& node) {
  return list_of<HarmonicMode>(mode, context, node);
}

OutputWindow window(const Context& context, const toml::node& node) {
  const toml::table& table = entry_of({"from", "to", "every"}, context, node);
  const auto time = [&](std::string_view name) { return number(context, *table.get(name)); };
  return {time("from"), time("to"), time("every")};
}

std::vector<OutputWindow> windows(const Context& context, const toml::node& node) {
  return list_of<OutputWindow>(window, context, node);
}

}  // namespace

std::string place(const toml::node& node, const std::string& file) {
  if (is_from_setting(node)) return *node.source().path;
  return fmt::format("{}:{}", file, node.source().begin.line);
}

void refuse_key(const toml::table& scene, std::string_view table, std::string_view key, const std::string& file,
                const std::string& problem) {
  const auto owner = scene.at_path(table);
  const auto node = owner[key];
  throw InputError(fmt::format("{}: {}", place(node ? *node.node() : *owner.node(), file), problem));
}

std::optional<double> number_of(const toml::node& node) {
  if (const auto* value = node.as_floating_point()) return value->get();
  // value<double>() of the library refuses what lies beyond 2^53.
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

std::string accepted_text(const KeyDescription& key) {
  switch (key.type) {
    case ValueType::boolean:
      return "true or false";
    case ValueType::integer:
      return fmt::format("an integer, {}", key.range.text());
    case ValueType::number:
      return key.range.text() == Range{}.text() ? Range{}.text() : fmt::format("a number {}", key.range.text());
    case ValueType::word:
      return fmt::format("{}", fmt::join(key.words, ", "));
    case ValueType::text:
      return "a text in quotes";
    case ValueType::triple:
      return fmt::format("3 numbers [x, y, z], each {}", key.range.text());
    case ValueType::matrix:
      return "3 rows of 3 finite numbers";
    case ValueType::axis_angle:
      return "4 finite numbers [axis_x, axis_y, axis_z, degrees]";
    case ValueType::numbers:
      return fmt::format("a list of numbers, each {}", key.range.text());
    case ValueType::modes:
      return "entries {n = degree, m = -n ... n, a = finite number}";
    case ValueType::windows:
      return fmt::format("entries {{from = time, to = time, every = time}}, each {}", key.range.text());
    case ValueType::quantity:
      return fmt::format("a positive number with its unit in quotes, {}", find_dimension(key.unit)->accepted());
  }
  return {};
}

std::optional<double> si_number(const KeyDescription& key, const toml::node& node, const std::string& file,
                                const std::optional<UnitsScene>& units) {
  return number_in_si({key, file, units}, node);
}

Value checked_value(const KeyDescription& key, const toml::node& node, const std::string& file,
                    const std::optional<UnitsScene>& units) {
  const Context context{key, file, units};
  switch (key.type) {
    case ValueType::boolean:
      return boolean(context, node);
    case ValueType::integer:
      return integer(context, node);
    case ValueType::number:
      return number(context, node);
    case ValueType::word:
      return word(context, node);
    case ValueType::text:
      return text(context, node);
    case ValueType::triple:
      return triple(context, node);
    case ValueType::matrix:
      return matrix(context, node);
    case ValueType::axis_angle:
      return axis_angle(context, node);
    case ValueType::quantity:
      return quantity(context, node);
    case ValueType::numbers:
      return numbers(context, node);
    case ValueType::windows:
      return windows(context, node);
    case ValueType::modes:
      break;
  }
  return modes(context, node);
}

}  // namespace vehd

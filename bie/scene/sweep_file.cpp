#include "bie/scene/sweep_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <set>

#include "bie/scene/key_lookup.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/read/toml_values.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/settings.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {
namespace {

constexpr const char* values_form = "values = [...], or from, to and count, with scale = \"linear\" or \"log\"";

/// A value in one line of TOML.
std::string value_text(const toml::node& node) {
  std::vector<std::string> parts;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& part : *array) parts.push_back(value_text(part));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, part] : *table) parts.push_back(fmt::format("{} = {}", key.str(), value_text(part)));
    return fmt::format("{{{}}}", fmt::join(parts, ", "));
  }
  if (const auto* text = node.as_string()) return to_toml(Value(text->get()));
  if (const auto* number = node.as_floating_point()) return to_toml(Value(number->get()));
  if (const auto* number = node.as_integer()) return to_toml(Value(number->get()));
  return shown(node);
}

/// Reads one key of [vary].
class VariedKeyReader {
 public:
  /// @param scene  the base scene
  VariedKeyReader(const std::string& name, const toml::table& table, const TomlFile& file, const Scene& scene)
      : name_(name),
        table_(table),
        file_(file),
        units_(scene.units),
        descriptions_(keys_named(key_of_vesicle(name, vesicle_names(scene)), place(table, file.name), "[vary]")) {}

  /// @throws InputError if the key does not accept one of the values
  [[nodiscard]] VariedKey read() const {
    const toml::node* values = table_.get("values");
    std::vector<std::string_view> known{"values"};
    if (values == nullptr) known = {"values", "from", "to", "count", "scale"};
    for (const auto& [word, node] : table_) {
      if (std::ranges::find(known, word.str()) != known.end()) continue;
      refuse(node, "has an unknown \"{}\"; {}", word.str(), suggestion(word.str(), known));
    }
    VariedKey result{name_, {}, false};
    if (values == nullptr) {
      const toml::node* scale = table_.get("scale");
      const std::string word = scale != nullptr ? scale->value<std::string>().value_or("") : "linear";
      if (word != "linear" && word != "log") {
        refuse(*scale, "has scale = {}; accepted: \"linear\", \"log\"", shown(*scale));
      }
      result.is_logarithmic = word == "log";
      result.values = values_of_range(result.is_logarithmic);
      for (const char* end : {"from", "to"}) require_accepted(*table_.get(end));
      return result;
    }
    const toml::array* list = values->as_array();
    if (list == nullptr || list->empty()) refuse(*values, "has no list of values; accepted: {}", values_form);
    for (const toml::node& node : *list) {
      require_accepted(node);
      const std::string toml = value_text(node);
      result.values.push_back({toml, node.value<std::string>().value_or(toml)});
    }
    return result;
  }

 private:
  template <typename... Arguments>
  [[noreturn]] void refuse(const toml::node& node, fmt::format_string<Arguments...> problem,
                           Arguments&&... arguments) const {
    file_.refuse(node, "\"{}\" in [vary] {}", name_, fmt::format(problem, std::forward<Arguments>(arguments)...));
  }

  /// @throws InputError with the message of the first description if none accepts the value
  void require_accepted(const toml::node& node) const {
    std::exception_ptr first;
    for (const KeyDescription* description : descriptions_) {
      try {
        static_cast<void>(checked_value(*description, node, file_.name, units_));
        return;
      } catch (const InputError&) {
        if (!first) first = std::current_exception();
      }
    }
    std::rethrow_exception(first);
  }

  /// One end of a range: a number, or one with a unit.
  [[nodiscard]] Quantity end_of_range(const char* name) const {
    const toml::node* node = table_.get(name);
    if (node == nullptr) refuse(table_, "has no \"{}\"; accepted: {}", name, values_form);
    if (const auto number = number_of(*node)) return {*number, ""};
    const auto quantity = parse_quantity(node->value<std::string>().value_or(""));
    if (!quantity) refuse(*node, "has {} = {}; accepted: a number", name, shown(*node));
    return *quantity;
  }

  /// The end of a range in the unit of its start.
  [[nodiscard]] Quantity in_unit_of(const Quantity& from, Quantity to) const {
    if (from.unit == to.unit) return to;
    const Dimension* dimension = find_dimension(descriptions_.front()->unit);
    const auto factor = [&](const Quantity& end) {
      const Unit* unit = dimension != nullptr ? dimension->find(end.unit) : nullptr;
      const auto temperature = units_ ? units_->temperature : std::nullopt;
      return unit != nullptr ? Quantity{1.0, ""}.in_si(*unit, temperature) : std::nan("");
    };
    to.number *= factor(to) / factor(from);
    if (!std::isfinite(to.number)) {
      refuse(*table_.get("to"), "goes from a value in \"{}\" to one in \"{}\"; accepted: units of one dimension",
             from.unit, to.unit);
    }
    to.unit = from.unit;
    return to;
  }

  [[nodiscard]] std::vector<VariedValue> values_of_range(bool logarithmic) const {
    const Quantity from = end_of_range("from"), to = in_unit_of(from, end_of_range("to"));
    const toml::node* counted = table_.get("count");
    const std::int64_t count = counted != nullptr ? counted->value<std::int64_t>().value_or(0) : 0;
    if (count < 2 || count > static_cast<std::int64_t>(most_runs)) {
      refuse(counted != nullptr ? *counted : table_, "needs \"count\"; accepted: 2 ... {}", most_runs);
    }
    if (logarithmic && !(from.number * to.number > 0.0)) {
      refuse(*table_.get("from"), "goes by equal factors; accepted: two numbers of one sign, none of them 0");
    }
    const bool is_integer = descriptions_.front()->type == ValueType::integer;
    std::vector<VariedValue> values;
    for (std::int64_t i = 0; i < count; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(count - 1);
      double value = logarithmic ? from.number * std::pow(to.number / from.number, share)
                                 : from.number + share * (to.number - from.number);
      // The shortest number within rounding: 0.3 and not 0.30000000000000004.
      const std::string rounded = fmt::format("{:.14g}", value);
      std::from_chars(rounded.data(), rounded.data() + rounded.size(), value);
      if (i == count - 1) value = to.number;
      if (is_integer && value != std::round(value)) {
        refuse(*counted, "is a whole number and would become {}; accepted: another count", value);
      }
      const std::string number = to_toml(is_integer ? Value(static_cast<std::int64_t>(value)) : Value(value));
      const std::string text = from.unit.empty() ? number : fmt::format("{} {}", number, from.unit);
      values.push_back({from.unit.empty() ? text : to_toml(Value(text)), text});
    }
    return values;
  }

  const std::string& name_;
  const toml::table& table_;
  const TomlFile& file_;
  const std::optional<UnitsScene>& units_;
  std::vector<const KeyDescription*> descriptions_;
};

void require_sweep_words(const TomlFile& file) {
  const std::vector<std::string_view> words = {"scene", "vary", "mode", "columns"};
  for (const auto& [word, node] : file.table) {
    if (std::ranges::find(words, word.str()) != words.end()) continue;
    file.refuse(node, "unknown {} \"{}\" in a sweep; {}", node.is_table() ? "table" : "key", word.str(),
                suggestion(word.str(), words));
  }
}

std::filesystem::path base_scene(const TomlFile& file, const std::filesystem::path& folder) {
  const toml::node* node = file.table.get("scene");
  if (node == nullptr) {
    throw InputError(fmt::format("{}:1: missing key \"scene\"; accepted: path of a scene", file.name));
  }
  const auto text = node->value<std::string>();
  if (!text) file.refuse(*node, "\"scene\" is {}; accepted: path of a scene", shown(*node));
  const std::filesystem::path scene = (folder / *text).lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::exists(scene, ignored)) file.refuse(*node, "\"scene\" is {}: no such file", shown(*node));
  return scene;
}

/// A key may also be written without quotes, as nested tables: flow.rate = {...}.
void add_varied_keys(const toml::table& table, const std::string& prefix, const TomlFile& file, SweepFile& sweep) {
  for (const auto& [word, node] : table) {
    const std::string name = prefix + std::string(word.str());
    const toml::table* inner = node.as_table();
    if (inner == nullptr) {
      file.refuse(node, "\"{}\" in [vary] is {}; accepted: {{values = [...]}} or {{from, to, count}}", name,
                  shown(node));
    }
    if (!inner->empty() &&
        std::all_of(inner->begin(), inner->end(), [](const auto& entry) { return entry.second.is_table(); })) {
      add_varied_keys(*inner, name + ".", file, sweep);
      continue;
    }
    if (name == "output.units") {
      file.refuse(node, "\"{}\" in [vary]: one table has one set of units; give it in the scene", name);
    }
    sweep.keys.push_back(VariedKeyReader(name, *inner, file, sweep.scene).read());
  }
}

void read_varied_keys(const TomlFile& file, SweepFile& sweep) {
  const toml::table* vary = file.find("vary");
  if (vary == nullptr || vary->empty()) {
    throw InputError(
        fmt::format("{}:1: missing table [vary]; accepted: \"table.key\" = {{values = [...]}}", file.name));
  }
  add_varied_keys(*vary, "", file, sweep);
  // Restores the order of the file: the library sorts by name.
  const auto position = [vary](const VariedKey& key) {
    const toml::node* node = vary->get(key.name);
    if (node == nullptr) node = vary->at_path(key.name).node();
    return node != nullptr ? node->source().begin : toml::source_position{};
  };
  std::ranges::stable_sort(sweep.keys, [&](const auto& a, const auto& b) { return position(a) < position(b); });
}

/// Equal values would give equal runs of a grid.
void require_different_values(const VariedKey& key, const TomlFile& file) {
  std::set<std::string> values;
  for (const VariedValue& value : key.values) {
    if (values.insert(value.toml).second) continue;
    throw InputError(
        fmt::format("{}: \"{}\" in [vary] has {} twice; accepted: different values", file.name, key.name, value.shown));
  }
}

void read_sweep_mode(const TomlFile& file, SweepFile& sweep) {
  const toml::node* node = file.table.get("mode");
  const std::string mode = node != nullptr ? node->value<std::string>().value_or("") : "grid";
  if (mode != "grid" && mode != "zip") {
    file.refuse(*node, "\"mode\" is {}; accepted: \"grid\", \"zip\"", shown(*node));
  }
  sweep.mode = mode == "zip" ? SweepMode::zip : SweepMode::grid;
  const VariedKey& first = sweep.keys.front();
  for (const VariedKey& key : sweep.keys) {
    if (sweep.mode == SweepMode::grid) {
      require_different_values(key, file);
    } else if (key.values.size() != first.values.size()) {
      file.refuse(*node, "mode \"zip\": \"{}\" has {} values and \"{}\" has {}; accepted: as many", first.name,
                  first.values.size(), key.name, key.values.size());
    }
  }
  if (sweep.n_runs() > most_runs) {
    throw InputError(fmt::format("{}: makes more than {} runs; accepted: at most that many", file.name, most_runs));
  }
}

void read_sweep_columns(const TomlFile& file, SweepFile& sweep) {
  const toml::node* node = file.table.get("columns");
  if (node == nullptr) return;
  const auto refuse = [&](const toml::node& wrong) {
    file.refuse(wrong, "\"columns\" has {}; accepted: a list of columns of history.csv", shown(wrong));
  };
  const toml::array* names = node->as_array();
  if (names == nullptr) return refuse(*node);
  for (const toml::node& name : *names) {
    if (!name.is_string()) refuse(name);
    sweep.columns.push_back({name.as_string()->get(), place(name, file.name)});
  }
}

}  // namespace

std::size_t SweepFile::n_runs() const {
  if (mode == SweepMode::zip) return keys.front().values.size();
  std::size_t count = 1;
  for (const VariedKey& key : keys) count = std::min(count * key.values.size(), most_runs + 1);
  return count;
}

std::vector<VariedValue> SweepFile::values_of(std::size_t run) const {
  std::vector<VariedValue> values(keys.size());
  for (std::size_t k = keys.size(); k-- > 0;) {
    const std::size_t count = keys[k].values.size();
    values[k] = keys[k].values[run % count];
    if (mode == SweepMode::grid) run /= count;
  }
  return values;
}

SweepFile read_sweep(const std::filesystem::path& path) {
  const TomlFile file = parse_toml(text_of_toml_file(path, "a sweep"), path.string());
  require_sweep_words(file);
  SweepFile sweep;
  sweep.file = path;
  sweep.scene_file = base_scene(file, path.parent_path());
  sweep.scene = read_scene(sweep.scene_file);
  read_varied_keys(file, sweep);
  read_sweep_mode(file, sweep);
  read_sweep_columns(file, sweep);
  return sweep;
}

}  // namespace vehd

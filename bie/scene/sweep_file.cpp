#include "bie/scene/sweep_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <set>

#include "bie/scene/key_lookup.hpp"
#include "bie/scene/read/toml_values.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/settings.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {
namespace {

constexpr const char* values_form = "values = [...], or from, to and count, with scale = \"linear\" or \"log\"";
constexpr const char* end_form = "a number, or values = [...]";

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
  VariedKeyReader(const std::string& name, const NamedTable& table, const Scene& scene)
      : name_(name),
        table_(table),
        units_(scene.units),
        descriptions_(
            keys_named(key_of_vesicle(name, vesicle_names(scene)), place(table.entries, table.file.name), "[vary]")) {}

  /// @throws InputError if the key does not accept one of the values
  [[nodiscard]] VariedKey read() const {
    VariedKey result{name_, {}, false};
    const toml::node* values = table_.entries.get("values");
    if (values == nullptr) {
      table_.require_words({"values", "from", "to", "count", "scale"});
      result.is_logarithmic = table_.word("scale", {"linear", "log"}) == "log";
      result.values = values_of_range(result.is_logarithmic);
      for (const char* end : {"from", "to"}) require_accepted(*table_.entries.get(end));
      return result;
    }
    table_.require_words({"values"});
    const toml::array* list = values->as_array();
    if (list == nullptr || list->empty()) table_.refuse(*values, "has no list of values; accepted: {}", values_form);
    for (const toml::node& node : *list) {
      require_accepted(node);
      const std::string toml = value_text(node);
      result.values.push_back({toml, node.value<std::string>().value_or(toml)});
    }
    return result;
  }

 private:
  /// @throws InputError with the message of the first description if none accepts the value
  void require_accepted(const toml::node& node) const {
    std::exception_ptr first;
    for (const KeyDescription* description : descriptions_) {
      try {
        static_cast<void>(checked_value(*description, node, table_.file.name, units_));
        return;
      } catch (const InputError&) {
        if (!first) first = std::current_exception();
      }
    }
    std::rethrow_exception(first);
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
      table_.refuse(*table_.entries.get("to"),
                    "goes from a value in \"{}\" to one in \"{}\"; accepted: units of one dimension", from.unit,
                    to.unit);
    }
    to.unit = from.unit;
    return to;
  }

  [[nodiscard]] std::vector<VariedValue> values_of_range(bool logarithmic) const {
    const Quantity from = table_.quantity("from", end_form);
    const Quantity to = in_unit_of(from, table_.quantity("to", end_form));
    const toml::node* counted = table_.entries.get("count");
    if (counted == nullptr) table_.refuse(table_.entries, "needs \"count\"; accepted: 2 ... {}", most_runs);
    const std::int64_t count = counted->value<std::int64_t>().value_or(0);
    if (count < 2 || count > static_cast<std::int64_t>(most_runs)) {
      table_.refuse_value("count", fmt::format("; accepted: an integer, 2 ... {}", most_runs));
    }
    if (logarithmic && !(from.number * to.number > 0.0)) {
      table_.refuse(*table_.entries.get("from"),
                    "goes by equal factors; accepted: two numbers of one sign, none of them 0");
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
        table_.refuse(*counted, "is a whole number and would become {}; accepted: another count", value);
      }
      const std::string number = to_toml(is_integer ? Value(static_cast<std::int64_t>(value)) : Value(value));
      const std::string text = from.unit.empty() ? number : fmt::format("{} {}", number, from.unit);
      values.push_back({from.unit.empty() ? text : to_toml(Value(text)), text});
    }
    return values;
  }

  const std::string& name_;
  const NamedTable& table_;
  const std::optional<UnitsScene>& units_;
  std::vector<const KeyDescription*> descriptions_;
};

void read_varied_keys(const TomlFile& file, SweepFile& sweep) {
  for_each_key(file, "vary", "{values = [...]} or {from, to, count}",
               [&](const std::string& name, const NamedTable& table) {
                 if (name == "output.units") {
                   table.refuse(table.entries, "would give one table several sets of units; accepted: in the scene");
                 }
                 sweep.keys.push_back(VariedKeyReader(name, table, sweep.scene).read());
               });
  // Restores the order of the file: the library sorts by name.
  const auto position = [&vary = *file.find("vary")](const VariedKey& key) {
    const toml::node* node = vary.get(key.name);
    if (node == nullptr) node = vary.at_path(key.name).node();
    return node != nullptr ? node->source().begin : toml::source_position{};
  };
  std::ranges::stable_sort(sweep.keys, [&](const auto& a, const auto& b) { return position(a) < position(b); });
}

/// Equal values would give equal runs of a grid.
void require_different_values(const VariedKey& key, const TomlFile& file) {
  std::set<std::string> values;
  for (const VariedValue& value : key.values) {
    if (values.insert(value.toml).second) continue;
    file.refuse(*file.table.get("vary"), "\"{}\" in [vary] has {} twice; accepted: different values", key.name,
                value.shown);
  }
}

void read_sweep_mode(const NamedTable& table, SweepFile& sweep) {
  const TomlFile& file = table.file;
  sweep.mode = table.word("mode", {"grid", "zip"}) == "zip" ? SweepMode::zip : SweepMode::grid;
  const VariedKey& first = sweep.keys.front();
  for (const VariedKey& key : sweep.keys) {
    if (sweep.mode == SweepMode::grid) {
      require_different_values(key, file);
    } else if (key.values.size() != first.values.size()) {
      file.refuse(*file.table.get("mode"), "mode \"zip\": \"{}\" has {} values and \"{}\" has {}; accepted: as many",
                  first.name, first.values.size(), key.name, key.values.size());
    }
  }
  if (sweep.n_runs() > most_runs) {
    file.refuse(*file.table.get("vary"), "[vary] makes more than {0} runs; accepted: at most {0}", most_runs);
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
  const NamedTable table{file, file.table, "a sweep"};
  table.require_words({"scene", "vary", "mode", "columns"});
  SweepFile sweep;
  sweep.file = path;
  sweep.scene_file = table.path("scene", "path of a scene", path.parent_path());
  sweep.scene = read_scene(sweep.scene_file);
  read_varied_keys(file, sweep);
  read_sweep_mode(table, sweep);
  read_sweep_columns(file, sweep);
  return sweep;
}

}  // namespace vehd

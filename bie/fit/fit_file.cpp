#include "bie/fit/fit_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/fit/data_table.hpp"
#include "bie/scene/key_lookup.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/read/toml_values.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

void require_words(const TomlFile& file, const toml::table& table, const std::vector<std::string_view>& words,
                   std::string_view where) {
  for (const auto& [word, node] : table) {
    if (std::ranges::find(words, word.str()) != words.end()) continue;
    file.refuse(node, "unknown key \"{}\" in {}; {}", word.str(), where, suggestion(word.str(), words));
  }
}

/// Text of a key; empty if the key is optional and absent.
std::string text_in(const TomlFile& file, const toml::table& table, const char* key, const char* accepted,
                    bool is_required) {
  const toml::node* node = table.get(key);
  if (node == nullptr && !is_required) return "";
  if (node == nullptr) file.refuse(table, "missing key \"{}\" in [[experiment]]; accepted: {}", key, accepted);
  const auto text = node->value<std::string>();
  if (!node->is_string() || text->empty())
    file.refuse(*node, "\"{}\" is {}; accepted: {}", key, shown(*node), accepted);
  return *text;
}

std::filesystem::path file_in(const TomlFile& file, const toml::table& table, const char* key, const char* accepted,
                              const std::filesystem::path& folder) {
  const std::filesystem::path path = (folder / text_in(file, table, key, accepted, true)).lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    file.refuse(*table.get(key), "\"{}\" is {}: no such file", key, shown(*table.get(key)));
  }
  return path;
}

/// The deviation as text, "0.01" or "2 mV", given as a number or as a text with a unit.
std::string deviation_in(const TomlFile& file, const toml::table& table) {
  const toml::node* node = table.get("deviation");
  if (node == nullptr) return "";
  const auto number = number_of(*node);
  const std::string text = number ? fmt::format("{}", *number) : node->value<std::string>().value_or("");
  const auto quantity = parse_quantity(text);
  if (!quantity || !(quantity->number > 0.0)) {
    file.refuse(*node, "\"deviation\" is {}; accepted: a number above 0, with its unit where the data have one",
                shown(*node));
  }
  return text;
}

Experiment experiment_in(const TomlFile& file, const toml::table& table, const std::filesystem::path& folder) {
  require_words(file, table, {"name", "scene", "data", "quantity", "deviation"}, "[[experiment]]");
  const std::filesystem::path data = file_in(file, table, "data", "path of a CSV file", folder);
  Experiment experiment;
  experiment.source.file = file_in(file, table, "scene", "path of a scene", folder);
  experiment.scene = read_scene(experiment.source);
  experiment.name = text_in(file, table, "name", "a name", false);
  if (experiment.name.empty()) experiment.name = data.stem().string();
  const std::string quantity = text_in(file, table, "quantity", "a column of history.csv, or \"contour\"", true);
  read_data(experiment, DataTable(data), quantity, place(*table.get("quantity"), file.name), deviation_in(file, table));
  return experiment;
}

std::vector<Experiment> experiments_in(const TomlFile& file, const std::filesystem::path& folder) {
  const toml::array* tables = file.table.get_as<toml::array>("experiment");
  if (tables == nullptr || tables->empty() || !tables->is_array_of_tables()) {
    throw InputError(
        fmt::format("{}:1: no table [[experiment]]; accepted: one or more, with scene, data and quantity", file.name));
  }
  std::vector<Experiment> experiments;
  std::size_t n_data = 0;
  for (const toml::node& node : *tables) {
    experiments.push_back(experiment_in(file, *node.as_table(), folder));
    const std::string& name = experiments.back().name;
    // Names become parts of file names.
    const bool is_plain = name.find('/') == std::string::npos;
    const bool is_new = std::ranges::count(experiments, name, &Experiment::name) == 1;
    if (!is_plain || !is_new) {
      file.refuse(node, "an experiment has the name \"{}\"{}; accepted: a \"name\" {}", shortened(name),
                  is_plain ? ", as another one has" : "", is_plain ? "of its own" : "without /");
    }
    n_data += experiments.back().data.size();
  }
  for (Experiment& experiment : experiments) {
    experiment.tolerance = tolerance_for(experiment.data, run_error_in_deviations(n_data));
  }
  return experiments;
}

/// One key of [free].
class FreeKeyReader {
 public:
  FreeKeyReader(std::string name, const toml::table& table, const TomlFile& file)
      : name_(std::move(name)), table_(table), file_(file) {}

  [[nodiscard]] FreeKey read(const Scene& scene) const {
    require_words(file_, table_, {"from", "to", "scale"}, fmt::format("\"{}\" in [free]", name_));
    FreeKey key;
    key.name = name_;
    key.place = place(table_, file_.name);
    const KeyDescription& description = *keys_named(name_, key.place, "[free]").front();
    if (description.type != ValueType::number) {
      refuse(table_, fmt::format("is {}; accepted: a key of numbers", description.type_text()));
    }
    const Quantity from = end("from"), to = end("to");
    if (from.unit != to.unit)
      refuse(*table_.get("to"), fmt::format("goes from \"{}\" to \"{}\"; accepted: one unit", from.unit, to.unit));
    const std::string scale =
        table_.get("scale") != nullptr ? table_.get("scale")->value<std::string>().value_or("") : "log";
    if (scale != "log" && scale != "linear") {
      refuse(*table_.get("scale"),
             fmt::format("has scale = {}; accepted: \"log\", \"linear\"", shown(*table_.get("scale"))));
    }
    key.is_logarithmic = scale == "log";
    key.unit = from.written;
    key.from = from.number;
    key.to = to.number;
    if (!(key.from < key.to))
      refuse(*table_.get("to"), fmt::format("goes from {} to {}; accepted: from < to", key.from, key.to));
    if (key.is_logarithmic && !(key.from > 0.0)) {
      refuse(*table_.get("from"),
             fmt::format("goes from {}; accepted: a number above 0, or scale = \"linear\"", key.from));
    }
    key.start = start_of(key, description, scene);
    return key;
  }

 private:
  [[noreturn]] void refuse(const toml::node& node, const std::string& problem) const {
    file_.refuse(node, "\"{}\" in [free] {}", name_, problem);
  }

  [[nodiscard]] Quantity end(const char* word) const {
    const toml::node* node = table_.get(word);
    if (node == nullptr) refuse(table_, fmt::format("has no \"{}\"; accepted: {{from, to, scale}}", word));
    if (const auto number = number_of(*node)) return {*number, "", ""};
    const auto quantity = parse_quantity(node->value<std::string>().value_or(""));
    if (!quantity) refuse(*node, fmt::format("has {} = {}; accepted: a number", word, shown(*node)));
    return *quantity;
  }

  /// The value of the scene if it is inside the interval, otherwise the middle.
  [[nodiscard]] static double start_of(const FreeKey& key, const KeyDescription& description, const Scene& scene) {
    const double middle = key.is_logarithmic ? std::sqrt(key.from * key.to) : 0.5 * (key.from + key.to);
    const auto value = applies(description, scene) ? description.get(scene) : std::nullopt;
    const double* number = value ? std::get_if<double>(&*value) : nullptr;
    if (number == nullptr) return middle;
    double start = *number;
    if (!key.unit.empty()) {
      const Dimension* dimension = find_dimension(description.unit);
      const Unit* unit = dimension != nullptr ? dimension->find(parse_quantity("1 " + key.unit)->unit) : nullptr;
      if (unit == nullptr || !scene.units) return middle;
      start *= si_scale(scene.units, description.unit) / Quantity{1.0, ""}.in_si(*unit, scene.units->temperature);
    }
    return start > key.from && start < key.to ? start : middle;
  }

  std::string name_;
  const toml::table& table_;
  const TomlFile& file_;
};

/// A key may also be written without quotes, as nested tables.
void add_keys(const toml::table& table, const std::string& prefix, const TomlFile& file, const Scene& scene,
              std::vector<FreeKey>& keys) {
  for (const auto& [word, node] : table) {
    const std::string name = prefix + std::string(word.str());
    const toml::table* inner = node.as_table();
    if (inner == nullptr) file.refuse(node, "\"{}\" in [free] is {}; accepted: {{from, to, scale}}", name, shown(node));
    const bool is_key = inner->contains("from") || inner->contains("to") || inner->empty();
    if (is_key) keys.push_back(FreeKeyReader(name, *inner, file).read(scene));
    if (!is_key) add_keys(*inner, name + ".", file, scene, keys);
  }
}

/// Checks that all experiments accept both ends of each key's interval, with the other keys at their start.
void require_accepted(const std::vector<FreeKey>& keys, const std::vector<Experiment>& experiments) {
  for (const FreeKey& varied : keys) {
    for (const double number : {varied.from, varied.to}) {
      for (const Experiment& experiment : experiments) {
        SceneSource source = experiment.source;
        for (const FreeKey& key : keys) source.settings.push_back(key.setting_of(&key == &varied ? number : key.start));
        try {
          static_cast<void>(read_scene(source));
        } catch (const InputError& error) {
          throw InputError(fmt::format("{}: {}", varied.place, error.what()));
        }
      }
    }
  }
}

}  // namespace

FitFile parse_fit(const std::string& text, const std::string& name, const std::filesystem::path& folder) {
  const TomlFile file = parse_toml(text, name);
  require_words(file, file.table, {"experiment", "free"}, "a fit");
  FitFile fit;
  fit.file = name;
  fit.experiments = experiments_in(file, folder);
  const toml::table* free = file.find("free");
  if (free == nullptr || free->empty()) {
    throw InputError(fmt::format("{}:1: no table [free]; accepted: \"table.key\" = {{from, to, scale}}", name));
  }
  add_keys(*free, "", file, fit.experiments.front().scene, fit.keys);
  std::size_t n_data = 0;
  for (const Experiment& experiment : fit.experiments) n_data += experiment.data.size();
  if (n_data < fit.keys.size()) {
    file.refuse(*free, "[free] has {} keys for {} data; accepted: as many keys as data, or fewer", fit.keys.size(),
                n_data);
  }
  require_accepted(fit.keys, fit.experiments);
  return fit;
}

FitFile read_fit(const std::filesystem::path& path) {
  return parse_fit(text_of_toml_file(path, "a fit"), path.string(), path.parent_path());
}

}  // namespace vehd

#include "bie/fit/fit_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/scene/key_lookup.hpp"
#include "bie/scene/read/toml_values.hpp"
#include "bie/scene/reader.hpp"

namespace vehd {
namespace {

std::optional<Quantity> deviation_in(const NamedTable& table) {
  if (!table.entries.contains("deviation")) return std::nullopt;
  const std::string accepted = "a number above 0, with its unit where the data have one";
  const Quantity deviation = table.quantity("deviation", accepted);
  if (!(deviation.number > 0.0)) table.refuse_value("deviation", "; accepted: " + accepted);
  return deviation;
}

Experiment experiment_in(const NamedTable& table, const std::filesystem::path& folder) {
  table.require_words({"name", "scene", "data", "quantity", "deviation"});
  const std::filesystem::path file = table.path("data", "path of a CSV file", folder);
  Experiment experiment;
  experiment.source.file = table.path("scene", "path of a scene", folder);
  experiment.scene = read_scene(experiment.source);
  experiment.name = table.entries.contains("name") ? table.text("name", "a name") : file.stem().string();
  const std::string quantity = table.text("quantity", "a column of history.csv, or \"contour\"");
  const CsvTable data(file);
  if (data.n_rows() == 0) {
    throw InputError(fmt::format("{}: holds no numbers; accepted: a header and rows below it", file.string()));
  }
  read_data(experiment, data, quantity, place(*table.entries.get("quantity"), table.file.name), deviation_in(table));
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
    experiments.push_back(experiment_in({file, *node.as_table(), "[[experiment]]"}, folder));
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

/// The value of the scene if it is inside the interval, otherwise the middle.
double start_of(const FreeKey& key, const KeyDescription& description, const Scene& scene) {
  const double middle = key.is_logarithmic ? std::sqrt(key.from * key.to) : 0.5 * (key.from + key.to);
  const auto value = applies(description, scene) ? description.get(scene) : std::nullopt;
  const double* number = value ? std::get_if<double>(&*value) : nullptr;
  if (number == nullptr) return middle;
  double start = *number;
  if (!key.unit.empty()) {
    start *= si_scale(scene.units, description.unit) /
             unit_factor(scene, std::string(description.unit), key.unit, key.place);
  }
  return start > key.from && start < key.to ? start : middle;
}

/// One key of [free].
FreeKey free_key_in(const std::string& name, const NamedTable& table, const std::vector<Experiment>& experiments) {
  table.require_words({"from", "to", "scale"});
  FreeKey key;
  key.name = name;
  key.place = place(table.entries, table.file.name);
  const KeyDescription& description = *keys_named(name, key.place, "[free]").front();
  if (description.type != ValueType::number) {
    table.refuse(table.entries, "is {}; accepted: a key of numbers", description.type_text());
  }
  const Quantity from = table.quantity("from", "a number"), to = table.quantity("to", "a number");
  const toml::node &from_node = *table.entries.get("from"), &to_node = *table.entries.get("to");
  if (from.unit != to.unit) {
    table.refuse(to_node, "goes from \"{}\" to \"{}\"; accepted: one unit", from.unit, to.unit);
  }
  for (const Experiment& experiment : experiments) {
    unit_factor(experiment.scene, std::string(description.unit), from.unit,
                fmt::format("{}: {}", key.place, table.name));
    if (experiment.measured.abscissa == name) {
      table.refuse(table.entries, "is varied by the data of \"{}\"; accepted: another key", experiment.name);
    }
  }
  key.is_logarithmic = table.word("scale", {"log", "linear"}) == "log";
  key.unit = from.written;
  key.from = from.number;
  key.to = to.number;
  if (!(key.from < key.to)) {
    table.refuse(to_node, "goes from {} to {}; accepted: from < to", key.from, key.to);
  }
  if (key.is_logarithmic && !(key.from > 0.0)) {
    table.refuse(from_node, "goes from {}; accepted: a number above 0, or scale = \"linear\"", key.from);
  }
  key.start = start_of(key, description, experiments.front().scene);
  return key;
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
  NamedTable{file, file.table, "a fit"}.require_words({"experiment", "free"});
  FitFile fit;
  fit.file = name;
  fit.experiments = experiments_in(file, folder);
  for_each_key(file, "free", "{from, to, scale}", [&](const std::string& key, const NamedTable& table) {
    fit.keys.push_back(free_key_in(key, table, fit.experiments));
  });
  std::size_t n_data = 0;
  for (const Experiment& experiment : fit.experiments) n_data += experiment.data.size();
  if (n_data < fit.keys.size()) {
    file.refuse(*file.find("free"), "[free] has {} keys for {} data; accepted: as many keys as data, or fewer",
                fit.keys.size(), n_data);
  }
  require_accepted(fit.keys, fit.experiments);
  return fit;
}

FitFile read_fit(const std::filesystem::path& path) {
  return parse_fit(text_of_toml_file(path, "a fit"), path.string(), path.parent_path());
}

}  // namespace vehd

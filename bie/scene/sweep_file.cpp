#include "bie/scene/sweep_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bie/scene/nearest_name.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/toml_file.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/varied_values.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

const std::vector<std::string_view> sweep_words = {"scene", "vary", "mode", "columns"};

void require_sweep_words(const toml::table& table, const std::string& file) {
  for (const auto& [word, node] : table) {
    if (std::find(sweep_words.begin(), sweep_words.end(), word.str()) != sweep_words.end()) continue;
    throw InputError(fmt::format("{}: unknown {} \"{}\" in a sweep; {}", place(node, file),
                                 node.is_table() ? "table" : "key", word.str(), suggestion(word.str(), sweep_words)));
  }
}

std::filesystem::path base_scene(const toml::table& table, const std::filesystem::path& path) {
  const std::string file = path.string();
  const toml::node* node = table.get("scene");
  if (node == nullptr) throw InputError(fmt::format("{}:1: missing key \"scene\"; accepted: path of a scene", file));
  const auto text = node->value<std::string>();
  if (!text) {
    throw InputError(fmt::format("{}: \"scene\" is {}; accepted: path of a scene", place(*node, file), shown(*node)));
  }
  const std::filesystem::path scene = (path.parent_path() / *text).lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::exists(scene, ignored)) {
    throw InputError(fmt::format("{}: \"scene\" is {}: no such file", place(*node, file), shown(*node)));
  }
  return scene;
}

/// A key may also stand without quotes, as a table within tables: flow.rate = {...}.
void add_varied_keys(const toml::table& table, const std::string& prefix, SweepFile& sweep) {
  const std::string file = sweep.file.string();
  // In the order of the file: the library sorts by name.
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (const auto& [word, node] : table) entries.emplace_back(prefix + std::string(word.str()), &node);
  for (const auto& [name, node] : entries) {
    const toml::table* inner = node->as_table();
    if (inner == nullptr) {
      throw InputError(fmt::format("{}: \"{}\" in [vary] is {}; accepted: {{values = [...]}} or {{from, to, count}}",
                                   place(*node, file), name, shown(*node)));
    }
    const bool all_are_tables = !inner->empty() && std::all_of(inner->begin(), inner->end(), [](const auto& entry) {
      return entry.second.is_table();
    });
    if (all_are_tables) {
      add_varied_keys(*inner, name + ".", sweep);
    } else {
      if (name == "output.units") {
        throw InputError(fmt::format("{}: \"{}\" in [vary]: one table has one set of units; give it in the scene",
                                     place(*node, file), name));
      }
      sweep.keys.push_back(varied_key(name, *inner, file, sweep.scene.units));
    }
  }
}

/// Line of a key in [vary], by which keys keep the order of the file.
toml::source_position position_of(const toml::table& vary, const std::string& name) {
  if (const toml::node* node = vary.get(name)) return node->source().begin;
  const auto node = vary.at_path(name);
  return node ? node.node()->source().begin : toml::source_position{};
}

void read_varied_keys(const toml::table& table, SweepFile& sweep) {
  const std::string file = sweep.file.string();
  const toml::table* vary = table.get("vary") != nullptr ? table.get("vary")->as_table() : nullptr;
  if (vary == nullptr || vary->empty()) {
    throw InputError(fmt::format("{}:1: missing table [vary]; accepted: \"table.key\" = {{values = [...]}}", file));
  }
  add_varied_keys(*vary, "", sweep);
  std::stable_sort(sweep.keys.begin(), sweep.keys.end(), [&](const VariedKey& a, const VariedKey& b) {
    return position_of(*vary, a.name) < position_of(*vary, b.name);
  });
}

/// Two runs of a grid would be the same.
void require_different_values(const VariedKey& key, const std::string& file) {
  std::set<std::string> values;
  for (const VariedValue& value : key.values) {
    if (values.insert(value.toml).second) continue;
    throw InputError(
        fmt::format("{}: \"{}\" in [vary] has {} twice; accepted: different values", file, key.name, value.shown));
  }
}

void read_sweep_mode(const toml::table& table, SweepFile& sweep) {
  const std::string file = sweep.file.string();
  const toml::node* node = table.get("mode");
  const std::string mode = node != nullptr ? node->value<std::string>().value_or("") : "grid";
  if (mode != "grid" && mode != "zip") {
    throw InputError(fmt::format("{}: \"mode\" is {}; accepted: \"grid\", \"zip\"", place(*node, file), shown(*node)));
  }
  sweep.mode = mode == "zip" ? SweepMode::zip : SweepMode::grid;
  const std::size_t count = sweep.keys.front().values.size();
  for (const VariedKey& key : sweep.keys) {
    if (sweep.mode == SweepMode::grid || key.values.size() == count) continue;
    throw InputError(fmt::format("{}: mode \"zip\": \"{}\" has {} values and \"{}\" has {}; accepted: as many",
                                 place(*node, file), sweep.keys.front().name, count, key.name, key.values.size()));
  }
  std::size_t n_runs = 1;
  for (const VariedKey& key : sweep.keys) {
    if (sweep.mode == SweepMode::grid) require_different_values(key, file);
    n_runs = sweep.mode == SweepMode::zip ? count : n_runs * key.values.size();
    if (n_runs > most_runs) {
      throw InputError(fmt::format("{}: asks for more runs than {}; accepted: at most as many", file, most_runs));
    }
  }
}

void read_sweep_columns(const toml::table& table, SweepFile& sweep) {
  const toml::node* node = table.get("columns");
  if (node == nullptr) return;
  const std::string file = sweep.file.string();
  const toml::array* names = node->as_array();
  const auto refuse = [&](const toml::node& wrong) {
    throw InputError(fmt::format("{}: \"columns\" has {}; accepted: a list of columns of history.csv",
                                 place(wrong, file), shown(wrong)));
  };
  if (names == nullptr) return refuse(*node);
  for (const toml::node& name : *names) {
    if (!name.is_string()) refuse(name);
    sweep.columns.push_back({name.as_string()->get(), place(name, file)});
  }
}

}  // namespace

std::size_t SweepFile::n_runs() const {
  if (mode == SweepMode::zip) return keys.front().values.size();
  std::size_t count = 1;
  for (const VariedKey& key : keys) count *= key.values.size();
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
  const toml::table table = parse_toml(text_of_toml_file(path, "a sweep"), path.string());
  require_sweep_words(table, path.string());
  SweepFile sweep;
  sweep.file = path;
  sweep.scene_file = base_scene(table, path);
  sweep.scene = read_scene(sweep.scene_file);
  read_varied_keys(table, sweep);
  read_sweep_mode(table, sweep);
  read_sweep_columns(table, sweep);
  return sweep;
}

}  // namespace vehd

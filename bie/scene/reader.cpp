#include "bie/scene/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/files/run_reader.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/read/toml_values.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {
namespace {

constexpr std::string_view vesicle_table = "vesicle";

/// Names of the keys of a table and of the tables in it.
std::vector<std::string_view> names_in(std::string_view table) {
  std::vector<std::string_view> names = key_names(table);
  const std::string start = fmt::format("{}.", table);
  for (const TableDescription& other : scene_tables()) {
    const std::string_view name = other.name;
    if (name.starts_with(start) && name.rfind('.') == table.size()) names.push_back(name.substr(start.size()));
  }
  return names;
}

std::string unknown_key_text(std::string_view table, std::string_view name) {
  const std::string start = fmt::format("unknown key \"{}\" in [{}]", name, table);
  const std::vector<std::string_view> own = names_in(table);
  const std::vector<std::string_view> owners = tables_with(name);
  // A typing error is likelier than a key in a wrong table.
  if (owners.empty() || is_one_letter_off(name, own)) return fmt::format("{}; {}", start, suggestion(name, own));
  return fmt::format("{}; it belongs to [{}]", start, fmt::join(owners, "] or ["));
}

/// "kind "shear"", or "kinds "shear", "gradient"": all kinds that have a key of that name.
std::string kinds_text(std::string_view table, std::string_view name) {
  std::vector<std::string> kinds;
  for (const KeyDescription& key : scene_keys()) {
    if (key.table != table || key.name != name) continue;
    for (const std::string_view kind : key.kinds) kinds.push_back(fmt::format("\"{}\"", kind));
  }
  return fmt::format("kind{} {}", kinds.size() == 1 ? "" : "s", fmt::join(kinds, ", "));
}

/// @param name  the one of the two names of the key that the file uses
void read_key(Scene& scene, KeyDescription key, std::string_view name, const toml::node& node, const TomlFile& file) {
  key.name = name;
  key.set(scene, checked_value(key, node, file.name, scene.units));
}

bool has_key(const toml::table& table, const KeyDescription& key) {
  return table.contains(key.name) || (!key.other_name.empty() && table.contains(key.other_name));
}

void read_table(Scene& scene, const TableDescription& description, const toml::table& table, const TomlFile& file) {
  const std::string_view owner = description.name;
  const auto is_subtable = [&](const auto& entry) {
    return find_table(fmt::format("{}.{}", owner, entry.first.str())) != nullptr;
  };
  // A file that has only [electric.waveform] makes TOML create [electric] as well.
  if (!table.empty() && !description.present(Scene{}) && std::all_of(table.begin(), table.end(), is_subtable)) {
    file.refuse(table.begin()->second, "[{0}.{1}] without [{0}]: there is nothing that it could act on", owner,
                table.begin()->first.str());
  }
  description.create(scene);
  // The kind decides which of the other keys are accepted.
  const KeyDescription* kind_row = kind_key(owner);
  if (kind_row != nullptr) {
    const toml::node* node = table.get(kind_row->name);
    if (node == nullptr) {
      file.refuse(table, "missing key \"{}\" in [{}]; accepted: {}", kind_row->name, owner, kind_row->accepted_text());
    }
    read_key(scene, *kind_row, kind_row->name, *node, file);
  }
  const std::string kind = kind_of(scene, owner);
  for (const auto& entry : table) {
    const auto& [name, node] = entry;
    if (kind_row != nullptr && name.str() == kind_row->name) continue;
    if (is_subtable(entry)) {
      if (node.is_table()) continue;
      file.refuse(node, "\"{0}\" in [{1}] is {2}; accepted: a table [{1}.{0}]", name.str(), owner, shown(node));
    }
    if (find_key(owner, name.str()) == nullptr) file.refuse(node, "{}", unknown_key_text(owner, name.str()));
    const KeyDescription* key = find_key_of_kind(owner, name.str(), kind);
    if (key == nullptr) {
      file.refuse(node, "key \"{}\" in [{}] belongs to {}, not to \"{}\"", name.str(), owner,
                  kinds_text(owner, name.str()), kind);
    }
    if (!key->other_name.empty() && table.contains(key->name) && table.contains(key->other_name)) {
      file.refuse(*table.get(key->other_name),
                  "\"{}\" in [{}] is another name of \"{}\", which is there as well; accepted: one of them",
                  key->other_name, owner, key->name);
    }
    read_key(scene, *key, name.str(), node, file);
  }
}

/// "its default of 1 would be 1.2e-04 F/m^2", for these units.
std::string default_text(const KeyDescription& key, const std::optional<UnitsScene>& units) {
  const double value = std::get<double>(*default_value(key));
  const double si = value * si_scale(units, key.unit);
  return fmt::format("its default of {:g} {}", value,
                     std::isnan(si) ? "depends on [units]"
                                    : fmt::format("would be {:.2g} {}", si, find_dimension(key.unit)->si_unit()));
}

/// Checks that the file has every key that the scene needs.
void require_keys(const Scene& scene, const TomlFile& file) {
  for (const KeyDescription& key : scene_keys()) {
    const toml::table* table = file.find(key.table);
    if (!applies(key, scene) || !needs_value(key, scene) || (table != nullptr && has_key(*table, key))) continue;
    const std::string why = key.required ? "" : "; " + default_text(key, scene.units);
    file.refuse(table != nullptr ? *table : *file.find("units"), "missing key \"{}\" in [{}] ({}){}; accepted: {}",
                key.name, key.table, key.description, why, key.accepted_text());
  }
}

/// Sets the defaults that depend on the tolerance, for keys that the file leaves out.
void apply_tolerance(NumericsScene& numerics, const toml::table& table) {
  if (!numerics.tolerance) return;
  if (!has_key(table, *find_key("numerics", "time_order"))) numerics.time_order = highest_time_order;
  if (!has_key(table, *find_key("numerics", "degree"))) numerics.order = default_order(*numerics.tolerance);
}

/// Sets the reduced volume from the excess area or to the default of the shape.
void settle_reduced_volume(const Scene& scene, ShapeScene& shape, const TomlFile& file) {
  const KeyDescription* key = find_key_of_kind("shape", "reduced_volume", kind_of(scene, "shape"));
  if (key == nullptr) return;
  if (shape.excess_area) {
    if (shape.reduced_volume) {
      file.refuse_key("shape", "excess_area",
                      "\"excess_area\" in [shape] together with \"reduced_volume\"; accepted: one of them");
    }
    shape.reduced_volume = std::pow(1.0 + *shape.excess_area / (4.0 * std::numbers::pi), -1.5);
    if (!key->accepts(*shape.reduced_volume)) {
      file.refuse_key(
          "shape", "excess_area",
          "\"excess_area\" in [shape] is {:g}, a reduced volume of {:.3g}; accepted: a reduced volume of {}",
          *shape.excess_area, *shape.reduced_volume, key->accepted_text());
    }
    shape.excess_area.reset();
  }
  if (shape.reduced_volume || !has_unit_size(shape.kind)) return;
  if (shape.kind != ShapeKind::biconcave) {
    file.refuse(*file.find("shape"), "missing key \"reduced_volume\" in [shape] ({}); accepted: {}", key->description,
                key->accepted_text());
  }
  shape.reduced_volume = 0.65;
}

/// Scales the field to `field_magnitude` if the scene gives that; a field of magnitude 0 keeps its direction.
void scale_field(ElectricScene& electric, const TomlFile& file) {
  if (!electric.field_magnitude) return;
  const double size = std::hypot(electric.field[0], electric.field[1], electric.field[2]);
  if (size == 0.0) {
    file.refuse_key("electric", "field",
                    "\"field\" in [electric] is 0 beside \"field_magnitude\"; accepted: a direction");
  }
  if (*electric.field_magnitude == 0.0) electric.direction = electric.field;
  for (double& component : electric.field) component *= *electric.field_magnitude / size;
  electric.field_magnitude.reset();
}

/// Checks that the file has only tables that a scene may have.
void require_known_tables(const TomlFile& file) {
  std::vector<std::string_view> known;
  for (const TableDescription& table : scene_tables()) {
    if (table.name.find('.') == std::string_view::npos) known.push_back(table.name);
  }
  known.push_back(vesicle_table);
  for (const auto& [key, node] : file.table) {
    if (std::ranges::find(known, key.str()) == known.end()) {
      file.refuse(node, "unknown {} \"{}\"; {}", node.is_table() ? "table" : "key", key.str(),
                  suggestion(key.str(), known));
    }
    if (!node.is_table() && key.str() != vesicle_table) {
      file.refuse(node, "\"{0}\" is {1}; accepted: a table [{0}]", key.str(), shown(node));
    }
  }
}

/// The scene of one vesicle, not yet checked.
/// @param units  those of the other vesicles; null: they follow from the file
Scene scene_of(const TomlFile& file, const std::filesystem::path& folder, const std::optional<UnitsScene>* units) {
  Scene scene;
  for (const TableDescription& description : scene_tables()) {
    if (const toml::table* table = file.find(description.name)) {
      read_table(scene, description, *table, file);
      if (description.name != "units") continue;
      // [units] comes first: the values of every later table may need its scales.
      if (units) {
        scene.units = *units;
      } else {
        derive_reference_scales(*scene.units, file);
      }
    } else if (description.required) {
      throw InputError(
          fmt::format("{}:1: missing table [{}] ({})", file.name, description.name, description.description));
    }
  }
  require_keys(scene, file);
  settle_reduced_volume(scene, scene.shape, file);
  if (scene.electric) scale_field(*scene.electric, file);
  read_number_files(scene, file, folder);
  apply_tolerance(scene.numerics, *file.find("numerics"));
  return scene;
}

/// Checks that a table of a vesicle has only keys that may differ between vesicles.
void check_table(std::string_view owner, const toml::table& values, const TomlFile& file) {
  if (owner == "electric" && !file.table.contains("electric")) {
    file.refuse(values, "[vesicle.electric] without [electric]: there is no field that could act on it");
  }
  for (const auto& [key, node] : values) {
    const bool is_known = find_key(owner, key.str()) != nullptr || node.is_table();
    if (!is_known || is_of_vesicle(owner, key.str())) continue;
    file.refuse(node, "\"{0}\" in [vesicle.{1}] is the same for all vesicles; accepted: in [{1}]", key.str(), owner);
  }
}

void check_vesicle(const toml::node& entry, const TomlFile& file) {
  const toml::table* table = entry.as_table();
  if (table == nullptr) file.refuse(entry, "an entry of [[vesicle]] is {}; accepted: tables", shown(entry));
  std::vector<std::string_view> known = vesicle_tables();
  known.emplace_back("name");
  for (const auto& [key, node] : *table) {
    if (key.str() == "name") continue;
    if (std::ranges::find(known, key.str()) == known.end()) {
      file.refuse(node, "unknown key \"{}\" in [[vesicle]]; {}", key.str(), suggestion(key.str(), known));
    }
    if (!node.is_table()) {
      file.refuse(node, "\"{0}\" in [[vesicle]] is {1}; accepted: a table [vesicle.{0}]", key.str(), shown(node));
    }
    check_table(key.str(), *node.as_table(), file);
  }
  if (!file.table.contains("shape") && !table->contains("shape")) {
    file.refuse(entry, "[[vesicle]] without [vesicle.shape], and there is no [shape] for all");
  }
}

/// @param number  of the vesicle, which is its name if none is given
std::string name_of(const toml::table& vesicle, std::size_t number, const TomlFile& file) {
  constexpr std::size_t longest_name = 64;
  const toml::node* node = vesicle.get("name");
  if (node == nullptr) return fmt::format("{}", number);
  const std::string name = node->value<std::string>().value_or("");
  const auto is_plain = [](unsigned char letter) { return letter >= 0x20 && letter != 0x7f && letter != '"'; };
  if (name.empty() || name.size() > longest_name || !std::ranges::all_of(name, is_plain)) {
    file.refuse(
        *node,
        "\"name\" in [[vesicle]] is {}; accepted: a text of 1 to {} bytes without double quotes and control characters",
        shown(*node), longest_name);
  }
  return name;
}

/// Checks every table [[vesicle]]. @return names of the vesicles, by default their numbers from 0
std::vector<std::string> read_vesicle_names(const TomlFile& file) {
  const toml::node& node = *file.table.get(vesicle_table);
  const toml::array* entries = node.as_array();
  if (entries == nullptr || entries->empty()) {
    file.refuse(node, "\"vesicle\" is {}; accepted: tables [[vesicle]]", shown(node));
  }
  if (entries->size() > most_vesicles) {
    file.refuse(node, "{} tables [[vesicle]]; accepted: at most {}", entries->size(), most_vesicles);
  }
  std::vector<std::string> names;
  for (const toml::node& entry : *entries) {
    check_vesicle(entry, file);
    const std::string name = name_of(*entry.as_table(), names.size(), file);
    if (std::ranges::find(names, name) != names.end()) {
      file.refuse(entry, "two vesicles have the name \"{}\"", name);
    }
    names.push_back(name);
  }
  return names;
}

/// Reduces a file to one of its vesicles, whose values replace those for all vesicles. A [vesicle.shape] with a kind
/// replaces [shape] as a whole. Every value keeps its line number.
void take_vesicle(toml::table& file, std::size_t vesicle) {
  toml::table own = std::move(*(*file[vesicle_table].as_array())[vesicle].as_table());
  file.erase(vesicle_table);
  own.erase("name");
  if (own["shape"]["kind"]) file.erase("shape");
  merge_tables(file, std::move(own));
}

/// @param all  vesicles of the scene
void check_one(Scene& scene, const TomlFile& file, const std::filesystem::path& folder, const std::vector<Scene>& all) {
  if (scene.shape.kind == ShapeKind::file) {
    scene.shape.path = std::filesystem::absolute(folder / scene.shape.path).lexically_normal().string();
  }
  check_scene(scene, file, all);
  if (has_reduced_volume(scene)) return;
  file.refuse_key(
      "shape", "kind",
      "the shape in [shape] does not reach the reduced volume {:.4g}, moved towards a sphere or away from it; "
      "accepted: another volume or shape",
      *scene.shape.reduced_volume);
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) { return read_scene(SceneSource{path, {}}); }

Scene read_scene(const SceneSource& source) {
  return parse_scene(source.text ? *source.text : text_of_toml_file(source.file, "a scene file"), source.file.string(),
                     source.file.parent_path(), source.settings);
}

Scene parse_scene(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                  const std::vector<std::string>& settings) {
  const auto parsed = [&] {
    TomlFile file = parse_toml(text, name);
    apply_settings(file.table, settings);
    return file;
  };
  const TomlFile file = parsed();
  require_known_tables(file);
  Scene scene;
  if (file.table.contains(vesicle_table)) {
    if (const toml::node* suspension = file.table.get("suspension")) {
      file.refuse(*suspension, "[suspension] beside tables [[vesicle]]; accepted: one of them");
    }
    const std::vector<std::string> names = read_vesicle_names(file);
    std::vector<TomlFile> files;
    std::vector<Scene> scenes;
    for (std::size_t a = 0; a < names.size(); ++a) {
      take_vesicle(files.emplace_back(parsed()).table, a);
      // All vesicles share the scales of the first.
      scenes.push_back(scene_of(files.back(), folder, scenes.empty() ? nullptr : &scenes.front().units));
    }
    const std::vector<Scene> all = scenes;
    for (std::size_t a = 0; a < scenes.size(); ++a) check_one(scenes[a], files[a], folder, all);
    scene = together(scenes, names);
  } else {
    scene = scene_of(file, folder, nullptr);
    check_one(scene, file, folder, {scene});
    if (scene.suspension) scene = placed_suspension(scene, file);
  }
  check_vesicles(scene, file);
  if (scene.wall) check_wall(scene, file);
  return scene;
}

std::optional<UnitsScene> parse_units(const std::string& text, const std::string& name) {
  const TomlFile file = parse_toml(text, name);
  const toml::table* table = file.find("units");
  if (table == nullptr) return std::nullopt;
  Scene scene;
  read_table(scene, *find_table("units"), *table, file);
  return scene.units;
}

std::optional<UnitsScene> units_of(const RunReader& run) {
  return run.has_scene() ? parse_units(run.scene(), run.name() + " (scene)") : std::nullopt;
}

}  // namespace vehd

#include "bie/scene/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/initial_material.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/place_checks.hpp"
#include "bie/scene/poration_checks.hpp"
#include "bie/scene/reference_scales.hpp"
#include "bie/scene/scene_checks.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/shape_file_check.hpp"
#include "bie/scene/suspension.hpp"
#include "bie/scene/toml_file.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/vesicle_checks.hpp"
#include "bie/scene/vesicle_reader.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/scene/waveform_file.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr std::string_view vesicle_table = "vesicle";

std::vector<std::string_view> table_names() {
  std::vector<std::string_view> names;
  for (const TableDescription& table : scene_tables()) {
    if (table.name.find('.') == std::string_view::npos) names.push_back(table.name);
  }
  names.push_back(vesicle_table);
  return names;
}

std::vector<std::string_view> key_names(std::string_view table) {
  std::vector<std::string_view> names;
  for (const KeyDescription& key : scene_keys()) {
    if (key.table == table && std::find(names.begin(), names.end(), key.name) == names.end()) names.push_back(key.name);
  }
  return names;
}

std::string unknown_key_text(std::string_view table, std::string_view name) {
  const std::string start = fmt::format("unknown key \"{}\" in [{}]", name, table);
  // A slip of the finger is likelier than a key in a wrong table.
  const std::vector<std::string_view> own = key_names(table);
  if (is_one_letter_off(name, own)) return fmt::format("{}; {}", start, suggestion(name, own));
  std::vector<std::string> owners;
  for (const TableDescription& other : scene_tables()) {
    if (find_key(other.name, name) != nullptr) owners.push_back(fmt::format("[{}]", other.name));
  }
  if (!owners.empty()) return fmt::format("{}; it belongs to {}", start, fmt::join(owners, " or "));
  return fmt::format("{}; {}", start, suggestion(name, own));
}

/// "kind "shear"", or "kinds "shear", "gradient"": all for which a key of that name exists.
std::string kinds_text(std::string_view table, std::string_view name) {
  std::vector<std::string> kinds;
  for (const KeyDescription& key : scene_keys()) {
    if (key.table != table || key.name != name) continue;
    for (const std::string_view kind : key.kinds) kinds.push_back(fmt::format("\"{}\"", kind));
  }
  return fmt::format("kind{} {}", kinds.size() == 1 ? "" : "s", fmt::join(kinds, ", "));
}

/// @param name  of the two that the key may have the one that the file has
void read_key(Scene& scene, KeyDescription key, std::string_view name, const toml::node& node,
              const std::string& file) {
  key.name = name;
  key.set(scene, checked_value(key, node, file, scene.units));
}

bool has_key(const toml::table& table, const KeyDescription& key) {
  return table.contains(key.name) || (!key.other_name.empty() && table.contains(key.other_name));
}

/// A key with two names is there under one of them.
void require_one_name(const KeyDescription& key, const toml::table& table, const std::string& file) {
  if (key.other_name.empty() || !table.contains(key.name) || !table.contains(key.other_name)) return;
  throw InputError(
      fmt::format("{}: \"{}\" in [{}] is another name of \"{}\", which is there as well; accepted: one "
                  "of them",
                  place(*table.get(key.other_name), file), key.other_name, key.table, key.name));
}

/// The table of a dotted name, or nullptr.
const toml::table* find_table(const toml::table& file, std::string_view name) { return file.at_path(name).as_table(); }

/// Whether "owner.name" is a table of its own.
bool is_subtable(std::string_view owner, std::string_view name) {
  const auto is_it = [&](const TableDescription& table) { return table.name == fmt::format("{}.{}", owner, name); };
  return std::any_of(scene_tables().begin(), scene_tables().end(), is_it);
}

/// [electric.waveform] alone makes TOML create [electric] as well.
void require_owner(const TableDescription& description, const toml::table& table, const std::string& file) {
  if (description.present(Scene{})) return;
  for (const auto& [name, node] : table) {
    if (!is_subtable(description.name, name.str())) return;
  }
  for (const auto& [name, node] : table) {
    throw InputError(fmt::format("{}: [{}.{}] without [{}]: there is nothing that it could act on", place(node, file),
                                 description.name, name.str(), description.name));
  }
}

void read_table(Scene& scene, const TableDescription& description, const toml::table& table, const std::string& file) {
  require_owner(description, table, file);
  description.create(scene);
  // The kind decides which of the other keys are accepted.
  const KeyDescription* kind_row = kind_key(description.name);
  if (kind_row != nullptr) {
    if (const toml::node* node = table.get(kind_row->name))
      read_key(scene, *kind_row, kind_row->name, *node, file);
    else {
      throw InputError(fmt::format("{}: missing key \"{}\" in [{}]; accepted: {}", place(table, file), kind_row->name,
                                   description.name, fmt::join(kind_row->words, ", ")));
    }
  }
  const std::string kind = kind_of(scene, description.name);
  for (const auto& [name, node] : table) {
    if (kind_row != nullptr && name.str() == kind_row->name) continue;
    if (is_subtable(description.name, name.str())) {
      if (node.is_table()) continue;
      throw InputError(fmt::format("{}: \"{}\" in [{}] is {}; accepted: a table [{}.{}]", place(node, file), name.str(),
                                   description.name, shown(node), description.name, name.str()));
    }
    if (find_key(description.name, name.str()) == nullptr) {
      throw InputError(fmt::format("{}: {}", place(node, file), unknown_key_text(description.name, name.str())));
    }
    const KeyDescription* key = find_key_of_kind(description.name, name.str(), kind);
    if (key == nullptr) {
      throw InputError(fmt::format("{}: key \"{}\" in [{}] belongs to {}, not to \"{}\"", place(node, file), name.str(),
                                   description.name, kinds_text(description.name, name.str()), kind));
    }
    require_one_name(*key, table, file);
    read_key(scene, *key, name.str(), node, file);
  }
}

/// "its default of 1 would be 1.2e-04 F/m^2", as it is in these units.
std::string default_text(const KeyDescription& key, const std::optional<UnitsScene>& units) {
  const double value = std::get<double>(*default_value(key));
  const double si = value * si_scale(units, key.unit);
  return fmt::format("its default of {:g} {}", value,
                     std::isnan(si) ? "depends on [units]"
                                    : fmt::format("would be {:.2g} {}", si, find_dimension(key.unit)->si_unit()));
}

/// Every key that the scene needs is in the file.
void require_keys(const Scene& scene, const toml::table& file, const std::string& name) {
  for (const KeyDescription& key : scene_keys()) {
    const toml::table* table = find_table(file, key.table);
    if (!applies(key, scene) || !needs_value(key, scene) || (table != nullptr && has_key(*table, key))) continue;
    const toml::table& owner = table != nullptr ? *table : *find_table(file, "units");
    const std::string why = key.required ? "" : "; " + default_text(key, scene.units);
    throw InputError(fmt::format("{}: missing key \"{}\" in [{}] ({}){}; accepted: {}", place(owner, name), key.name,
                                 key.table, key.description, why, accepted_text(key)));
  }
}

/// What a tolerance makes the default, where the scene says nothing itself.
void apply_tolerance(NumericsScene& numerics, const toml::table& file) {
  if (!numerics.tolerance) return;
  const toml::table& table = *find_table(file, "numerics");
  if (!has_key(table, *find_key("numerics", "time_order"))) numerics.time_order = highest_time_order;
  if (!has_key(table, *find_key("numerics", "degree"))) numerics.order = default_order(*numerics.tolerance);
}

/// Nothing but the tables that a scene may have.
void require_known_tables(const toml::table& file, const std::string& name) {
  for (const auto& [key, node] : file) {
    const std::vector<std::string_view> known = table_names();
    if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
      throw InputError(fmt::format("{}: unknown {} \"{}\"; {}", place(node, name), node.is_table() ? "table" : "key",
                                   key.str(), suggestion(key.str(), known)));
    }
    if (!node.is_table() && key.str() != vesicle_table) {
      throw InputError(fmt::format("{}: \"{}\" is {}; accepted: a table [{}]", place(node, name), key.str(),
                                   shown(node), key.str()));
    }
  }
}

/// The scene of one vesicle, not yet checked.
/// @param units  those of the other vesicles; null: they follow from the file
Scene scene_of(const toml::table& file, const std::string& name, const std::filesystem::path& folder,
               const std::optional<UnitsScene>* units) {
  Scene scene;
  for (const TableDescription& description : scene_tables()) {
    if (const toml::table* table = find_table(file, description.name)) {
      read_table(scene, description, *table, name);
      if (description.name != "units") continue;
      // [units] comes first: the values of every later table may need its scales.
      if (units) {
        scene.units = *units;
      } else {
        derive_reference_scales(*scene.units, file, name);
      }
    } else if (description.required) {
      throw InputError(fmt::format("{}:1: missing table [{}] ({})", name, description.name, description.description));
    }
  }
  require_keys(scene, file, name);
  MembraneScene& membrane = scene.membrane;
  for (auto* places : {&membrane.capacitance_by_place, &membrane.conductance_by_place, &membrane.bending_by_place,
                       &membrane.curvature_by_place}) {
    if (*places) read_place_file(**places, folder);
  }
  if (membrane.pump) {
    read_place_file(*membrane.pump, folder);
    if (membrane.pump->waveform) read_waveform_table(*membrane.pump->waveform, folder);
  }
  if (scene.flow && scene.flow->waveform) read_waveform_table(*scene.flow->waveform, folder);
  if (scene.electric && scene.electric->waveform) read_waveform_table(*scene.electric->waveform, folder);
  apply_tolerance(scene.numerics, file);
  return scene;
}

/// @param is_heavy  some vesicle of the scene has a weight
void check_one(Scene& scene, const toml::table& file, const std::string& name, const std::filesystem::path& folder,
               bool is_heavy) {
  check_scene(scene, file, name, is_heavy);
  check_places(scene, file, name);
  if (scene.shape.kind == ShapeKind::file) {
    scene.shape.path = std::filesystem::absolute(folder / scene.shape.path).lexically_normal().string();
  }
  check_shape_file(scene, file, name);
  check_shape_size(scene, file, name);
  check_poration(scene, file, name);
}

/// A scene with tables [[vesicle]].
/// @param files  that of each vesicle
Scene scene_of_several(const std::vector<toml::table>& files, const std::vector<std::string>& names,
                       const std::string& name, const std::filesystem::path& folder) {
  std::vector<Scene> scenes;
  for (const toml::table& file : files) {
    // Numbers of all vesicles have one scale.
    scenes.push_back(scene_of(file, name, folder, scenes.empty() ? nullptr : &scenes.front().units));
  }
  const bool is_heavy = std::any_of(scenes.begin(), scenes.end(),
                                    [](const Scene& scene) { return scene.fluid.density_difference != 0.0; });
  for (std::size_t a = 0; a < scenes.size(); ++a) check_one(scenes[a], files[a], name, folder, is_heavy);
  return together(scenes, names);
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
    toml::table file = parse_toml(text, name);
    apply_settings(file, settings);
    return file;
  };
  const toml::table file = parsed();
  require_known_tables(file, name);
  Scene scene;
  if (has_vesicles(file)) {
    if (const toml::node* suspension = file.get("suspension")) {
      throw InputError(
          fmt::format("{}: [suspension] beside tables [[vesicle]]; accepted: one of them", place(*suspension, name)));
    }
    const std::vector<std::string> names = read_vesicle_names(file, name);
    std::vector<toml::table> files;
    for (std::size_t a = 0; a < names.size(); ++a) {
      files.push_back(parsed());
      take_vesicle(files.back(), a);
    }
    scene = scene_of_several(files, names, name, folder);
    check_vesicles(scene, file, name);
  } else {
    scene = scene_of(file, name, folder, nullptr);
    check_one(scene, file, name, folder, false);
    if (scene.suspension) scene = placed_suspension(scene, file, name);
    check_vesicles(scene, file, name);
  }
  check_symmetry(scene, file, name);
  return scene;
}

std::optional<UnitsScene> parse_units(const std::string& text, const std::string& name) {
  const toml::table file = parse_toml(text, name);
  const toml::table* table = find_table(file, "units");
  if (table == nullptr) return std::nullopt;
  Scene scene;
  read_table(scene, scene_tables().front(), *table, name);
  return scene.units;
}

}  // namespace vehd

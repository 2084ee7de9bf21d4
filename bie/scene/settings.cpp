#include "bie/scene/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "bie/scene/schema.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr std::string_view option = "--set ";
constexpr std::string_view vesicle_prefix = "vesicle.";

std::string trimmed(const std::string& text) {
  const std::size_t start = text.find_first_not_of(" \t");
  return start == std::string::npos ? "" : text.substr(start, text.find_last_not_of(" \t") - start + 1);
}

/// Does the text consist of names of letters, digits, _ and -, separated by dots?
bool is_dotted_name(const std::string& text) {
  const auto fits = [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '_' || letter == '-' || letter == '.';
  };
  return !text.empty() && text.front() != '.' && text.back() != '.' && text.find("..") == std::string::npos &&
         std::ranges::all_of(text, fits);
}

/// Name and value of a setting.
std::pair<std::string, std::string> assignment_of(const std::string& setting) {
  const std::string form = "accepted: table.key=value, as in flow.rate=2.5";
  const auto refuse = [&](const std::string& problem, const std::string& accepted) {
    throw InputError(fmt::format("{}{}: {}; {}", option, setting, problem, accepted));
  };
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) refuse("no value", form);
  const std::string key = trimmed(setting.substr(0, equals));
  const auto n_points = std::ranges::count(key, '.');
  if (key.starts_with(vesicle_prefix)) return {key, trimmed(setting.substr(equals + 1))};
  if (!is_dotted_name(key) || (n_points > 2 && find_table(key.substr(0, key.rfind('.'))) == nullptr)) {
    refuse(fmt::format("\"{}\" is not a key", key), form);
  }
  if (n_points == 0) {
    if (find_table(key) != nullptr) refuse(fmt::format("\"{}\" is a table", key), form);
    std::vector<std::string> names;
    for (const std::string_view table : tables_with(key)) names.push_back(fmt::format("{}.{}", table, key));
    refuse(fmt::format("\"{}\" has no table", key),
           names.empty() ? form : fmt::format("accepted: {}", fmt::join(names, ", ")));
  }
  return {key, trimmed(setting.substr(equals + 1))};
}

/// Is the text a single value? Otherwise it could end its line and add a table.
bool is_toml_value(const std::string& text) {
  try {
    return toml::parse("value = " + text + "\n").size() == 1;
  } catch (const toml::parse_error&) {
    return false;
  }
}

/// Refuses numbers such as .5 and 5. that TOML writes in another way. As texts they would be wrong for every key.
void refuse_other_numbers(const std::string& text, const std::string& setting) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(number)) return;
  throw InputError(fmt::format("{}{}: {} is not a TOML number; write {}", option, setting, text, number));
}

/// Table of the vesicle that a setting "vesicle.NAME.table.key" names, and "table.key".
std::pair<toml::table*, std::string> of_vesicle(toml::table& file, const std::string& key, const std::string& setting) {
  const toml::array* vesicles = file["vesicle"].as_array();
  std::vector<std::string> names;
  for (std::size_t a = 0; vesicles != nullptr && a < vesicles->size(); ++a) {
    toml::table* table = (*file["vesicle"].as_array())[a].as_table();
    if (table == nullptr) continue;
    names.push_back((*table)["name"].value_or(std::to_string(a)));
    const std::string own_key = key_of_vesicle(key, {names.back()});
    if (own_key != key && is_dotted_name(own_key)) return {table, own_key};
  }
  throw InputError(fmt::format("{}{}: \"{}\" is not a key of a vesicle; accepted: vesicle.NAME.table.key{}{}", option,
                               setting, key, names.empty() ? ", in a scene with tables [[vesicle]]" : ", NAME of ",
                               fmt::join(names, ", ")));
}

/// Removes the other name of a key, and the other one of excess_area and reduced_volume: only one may be given.
void erase_conflicting_keys(toml::table& file, const std::string& name) {
  const std::size_t last = name.rfind('.');
  const std::string table = name.substr(0, last), word = name.substr(last + 1);
  const KeyDescription* key = find_key(table, word);
  toml::table* owner = file.at_path(table).as_table();
  if (key == nullptr || owner == nullptr) return;
  if (name == "shape.excess_area") owner->erase("reduced_volume");
  if (name == "shape.reduced_volume") owner->erase("excess_area");
  if (key->other_name.empty()) return;
  owner->erase(word == key->name ? key->other_name : key->name);
}

}  // namespace

std::string key_of_vesicle(const std::string& key, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const std::string start = fmt::format("{}{}.", vesicle_prefix, name);
    if (key.starts_with(start)) return key.substr(start.size());
  }
  return key;
}

void merge_tables(toml::table& to, toml::table&& from) {
  for (auto&& [key, node] : from) {
    toml::table* inner = node.as_table();
    toml::table* present = to[key.str()].as_table();
    if (inner != nullptr && present != nullptr) {
      merge_tables(*present, std::move(*inner));
    } else {
      node.visit([&to, name = key.str()](auto& value) { to.insert_or_assign(name, std::move(value)); });
    }
  }
}

void apply_settings(toml::table& file, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const auto [key, given] = assignment_of(setting);
    const auto [owner, own_key] =
        key.starts_with(vesicle_prefix) ? of_vesicle(file, key, setting) : std::pair(&file, key);
    erase_conflicting_keys(*owner, own_key);
    if (!is_toml_value(given)) refuse_other_numbers(given, setting);
    const std::string value = is_toml_value(given) ? given : to_toml(Value(given));
    merge_tables(*owner, toml::parse(own_key + " = " + value + "\n", std::string(option) + setting));
  }
}

bool is_from_setting(const toml::node& node) {
  return node.source().path != nullptr && node.source().path->starts_with(option);
}

}  // namespace vehd

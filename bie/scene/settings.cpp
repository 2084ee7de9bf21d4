#include "bie/scene/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "bie/scene/nearest_name.hpp"
#include "bie/scene/schema.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr std::string_view option = "--set ";

bool is_part_of_key(std::string_view part) {
  const auto fits = [](unsigned char letter) { return std::isalnum(letter) != 0 || letter == '_' || letter == '-'; };
  return !part.empty() && std::all_of(part.begin(), part.end(), fits);
}

std::string trimmed(const std::string& text) {
  const std::size_t start = text.find_first_not_of(" \t");
  return start == std::string::npos ? "" : text.substr(start, text.find_last_not_of(" \t") - start + 1);
}

/// Of "rate": flow.rate.
std::vector<std::string> full_names(std::string_view key) {
  std::vector<std::string> names;
  for (const TableDescription& table : scene_tables()) {
    if (find_key(table.name, key) != nullptr) names.push_back(fmt::format("{}.{}", table.name, key));
  }
  return names;
}

bool is_table(std::string_view name) {
  const auto is_it = [&](const TableDescription& table) { return table.name == name; };
  return std::any_of(scene_tables().begin(), scene_tables().end(), is_it);
}

/// Name and value of a setting.
struct Assignment {
  std::string key;
  std::string value;
};

Assignment assignment_of(const std::string& setting) {
  constexpr const char* form = "accepted: table.key=value, as in flow.rate=2.5";
  const std::string place = std::string(option) + setting;
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) throw InputError(fmt::format("{}: no value; {}", place, form));
  const std::string key = trimmed(setting.substr(0, equals));
  std::size_t n_parts = 0;
  for (std::size_t start = 0; start <= key.size(); ++n_parts) {
    const std::size_t end = std::min(key.find('.', start), key.size());
    if (!is_part_of_key(std::string_view(key).substr(start, end - start))) {
      throw InputError(fmt::format("{}: \"{}\" is no key; {}", place, key, form));
    }
    start = end + 1;
  }
  if (n_parts > 3 && !is_table(key.substr(0, key.rfind('.'))))
    throw InputError(fmt::format("{}: \"{}\" is no key; {}", place, key, form));
  if (n_parts == 1) {
    const auto names = full_names(key);
    throw InputError(fmt::format("{}: \"{}\" has no table; {}", place, key,
                                 names.empty() ? form : fmt::format("accepted: {}", fmt::join(names, ", "))));
  }
  return {key, trimmed(setting.substr(equals + 1))};
}

/// A value could otherwise end its line and go on with a table of its own.
bool is_toml_value(const std::string& text) {
  try {
    return toml::parse("value = " + text + "\n").size() == 1;
  } catch (const toml::parse_error&) {
    return false;
  }
}

/// A key of two names is not to be there under both.
void forget_other_name(toml::table& file, const std::string& name) {
  const std::size_t last = name.rfind('.');
  const std::string table = name.substr(0, last), word = name.substr(last + 1);
  const KeyDescription* key = find_key(table, word);
  toml::table* owner = file.at_path(table).as_table();
  if (key == nullptr || owner == nullptr || key->other_name.empty()) return;
  owner->erase(word == key->name ? key->other_name : key->name);
}

}  // namespace

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
    const Assignment given = assignment_of(setting);
    const std::string value = is_toml_value(given.value) ? given.value : to_toml(Value(given.value));
    forget_other_name(file, given.key);
    merge_tables(file, toml::parse(given.key + " = " + value + "\n", std::string(option) + setting));
  }
}

bool is_from_setting(const toml::node& node) {
  return node.source().path != nullptr && node.source().path->starts_with(option);
}

}  // namespace vehd

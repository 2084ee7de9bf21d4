#include "bie/scene/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "bie/scene/schema.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr std::string_view option = "--set ";

std::string trimmed(const std::string& text) {
  const std::size_t start = text.find_first_not_of(" \t");
  return start == std::string::npos ? "" : text.substr(start, text.find_last_not_of(" \t") - start + 1);
}

/// Names of letters, digits, _ and -, with points between them.
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
  if (!is_dotted_name(key) || (n_points > 2 && find_table(key.substr(0, key.rfind('.'))) == nullptr)) {
    refuse(fmt::format("\"{}\" is no key", key), form);
  }
  if (n_points == 0) {
    std::vector<std::string> names;
    for (const std::string_view table : tables_with(key)) names.push_back(fmt::format("{}.{}", table, key));
    refuse(fmt::format("\"{}\" has no table", key),
           names.empty() ? form : fmt::format("accepted: {}", fmt::join(names, ", ")));
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
    const auto [key, given] = assignment_of(setting);
    forget_other_name(file, key);
    const std::string value = is_toml_value(given) ? given : to_toml(Value(given));
    merge_tables(file, toml::parse(key + " = " + value + "\n", std::string(option) + setting));
  }
}

bool is_from_setting(const toml::node& node) {
  return node.source().path != nullptr && node.source().path->starts_with(option);
}

}  // namespace vehd

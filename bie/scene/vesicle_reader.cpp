#include "bie/scene/vesicle_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bie/scene/nearest_name.hpp"
#include "bie/scene/settings.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {
namespace {

/// What a vesicle says about a table: nothing but keys that vesicles may have for themselves.
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

/// @param number  the name of a vesicle that has none
std::string name_of(const toml::table& vesicle, std::size_t number, const TomlFile& file) {
  constexpr std::size_t longest_name = 64;
  const toml::node* node = vesicle.get("name");
  if (node == nullptr) return fmt::format("{}", number);
  const std::string name = node->value<std::string>().value_or("");
  const auto is_plain = [](unsigned char letter) { return letter >= 0x20 && letter != 0x7f && letter != '"'; };
  if (name.empty() || name.size() > longest_name || !std::ranges::all_of(name, is_plain)) {
    file.refuse(*node, "\"name\" in [[vesicle]] is {}; accepted: a text of 1 to {} letters", shown(*node),
                longest_name);
  }
  return name;
}

}  // namespace

std::vector<std::string> read_vesicle_names(const TomlFile& file) {
  const toml::node& node = *file.table.get("vesicle");
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

void take_vesicle(toml::table& file, std::size_t vesicle) {
  toml::table own = std::move(*(*file["vesicle"].as_array())[vesicle].as_table());
  file.erase("vesicle");
  own.erase("name");
  if (own["shape"]["kind"]) file.erase("shape");
  merge_tables(file, std::move(own));
}

}  // namespace vehd

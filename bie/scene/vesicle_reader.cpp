#include "bie/scene/vesicle_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "bie/scene/nearest_name.hpp"
#include "bie/scene/settings.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr const char* vesicle_key = "vesicle";
constexpr std::size_t longest_name = 64;

/// What is wrong with one table [[vesicle]].
class VesicleTableCheck {
 public:
  VesicleTableCheck(const toml::table& file, const toml::node& entry, const std::string& name)
      : file_(file), entry_(entry), name_(name) {}

  void run() const {
    if (!entry_.is_table())
      refuse(entry_, fmt::format("an entry of [[vesicle]] is {}; accepted: tables", shown(entry_)));
    std::vector<std::string_view> known = vesicle_tables();
    known.emplace_back("name");
    for (const auto& [key, node] : table()) {
      if (key.str() == "name") continue;
      if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
        refuse(node, fmt::format("unknown key \"{}\" in [[vesicle]]; {}", key.str(), suggestion(key.str(), known)));
      }
      if (!node.is_table()) {
        refuse(node, fmt::format("\"{}\" in [[vesicle]] is {}; accepted: a table [vesicle.{}]", key.str(), shown(node),
                                 key.str()));
      }
      check_table(key.str(), *node.as_table());
    }
    if (!file_.contains("shape") && !table().contains("shape")) {
      refuse(entry_, "[[vesicle]] without [vesicle.shape], and there is no [shape] for all");
    }
  }

  /// Empty: it has none. @throws InputError
  [[nodiscard]] std::string given_name() const {
    const toml::node* node = table().get("name");
    if (node == nullptr) return {};
    const auto* text = node->as_string();
    const auto is_plain = [](unsigned char letter) { return letter >= 0x20 && letter != 0x7f && letter != '"'; };
    if (text == nullptr || text->get().empty() || text->get().size() > longest_name ||
        !std::all_of(text->get().begin(), text->get().end(), is_plain)) {
      refuse(*node, fmt::format("\"name\" in [[vesicle]] is {}; accepted: a text of 1 to {} letters", shown(*node),
                                longest_name));
    }
    return text->get();
  }

  [[noreturn]] void refuse(const toml::node& node, const std::string& problem) const {
    throw InputError(fmt::format("{}: {}", place(node, name_), problem));
  }

 private:
  [[nodiscard]] const toml::table& table() const { return *entry_.as_table(); }

  void check_table(std::string_view owner, const toml::table& values) const {
    if (owner == "electric" && !file_.contains("electric")) {
      refuse(values, "[vesicle.electric] without [electric]: there is no field that could act on it");
    }
    for (const auto& [key, node] : values) {
      const bool is_known = find_key(owner, key.str()) != nullptr || node.is_table();
      if (!is_known || is_of_vesicle(owner, key.str())) continue;
      refuse(node, fmt::format("\"{}\" in [vesicle.{}] is the same for all vesicles; accepted: in [{}]", key.str(),
                               owner, owner));
    }
  }

  const toml::table& file_;
  const toml::node& entry_;
  const std::string& name_;
};

}  // namespace

bool has_vesicles(const toml::table& file) { return file.contains(vesicle_key); }

std::vector<std::string> read_vesicle_names(const toml::table& file, const std::string& name) {
  const toml::node& node = *file.get(vesicle_key);
  const toml::array* entries = node.as_array();
  if (entries == nullptr || entries->empty()) {
    throw InputError(
        fmt::format("{}: \"vesicle\" is {}; accepted: tables [[vesicle]]", place(node, name), shown(node)));
  }
  if (entries->size() > most_vesicles) {
    throw InputError(fmt::format("{}: {} tables [[vesicle]]; accepted: at most {}", place(node, name), entries->size(),
                                 most_vesicles));
  }
  std::vector<std::string> names;
  for (const toml::node& entry : *entries) {
    const VesicleTableCheck check(file, entry, name);
    check.run();
    const std::string given = check.given_name();
    const std::string own = given.empty() ? fmt::format("{}", names.size()) : given;
    if (std::find(names.begin(), names.end(), own) != names.end()) {
      check.refuse(entry, fmt::format("two vesicles have the name \"{}\"", own));
    }
    names.push_back(own);
  }
  return names;
}

void take_vesicle(toml::table& file, std::size_t vesicle) {
  toml::table own = std::move(*(*file[vesicle_key].as_array())[vesicle].as_table());
  file.erase(vesicle_key);
  own.erase("name");
  if (own["shape"]["kind"]) file.erase("shape");
  merge_tables(file, std::move(own));
}

}  // namespace vehd

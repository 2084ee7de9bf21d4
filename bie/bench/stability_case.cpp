#include "bie/bench/stability_case.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "bie/scene/read/toml_values.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// The criterion as TOML; all other lines are empty, so that line numbers are those of the file.
std::string criterion_text(const std::filesystem::path& path) {
  constexpr std::string_view mark = "#:";
  std::ifstream stream(path);
  std::string text;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(mark)) text += line.substr(mark.size());
    text += '\n';
  }
  return text;
}

class Criterion {
 public:
  explicit Criterion(const std::filesystem::path& path) : file_(parse_toml(criterion_text(path), path.string())) {
    for (const auto& [key, node] : file_.table) {
      static constexpr std::array keys = {"family", "expect", "short_end_time", "most", "falls", "steady"};
      if (std::ranges::find(keys, key.str()) != keys.end()) continue;
      file_.refuse(node, "unknown key \"{}\"; accepted: {}", key.str(), fmt::join(keys, ", "));
    }
  }

  [[nodiscard]] std::string text(const char* key) const { return text(key, required(key, "a text"), "a text"); }
  [[nodiscard]] double number(const char* key) const { return number(key, required(key, "a number")); }
  [[nodiscard]] std::vector<ColumnBound> bounds(const char* key) const {
    std::vector<ColumnBound> result;
    const toml::node* node = file_.table.get(key);
    if (node == nullptr) return result;
    const toml::table* table = node->as_table();
    if (table == nullptr) refuse(key, *node, "a table of columns and their bounds");
    for (const auto& [column, bound] : *table) result.push_back({std::string(column), number(column, bound)});
    return result;
  }
  [[nodiscard]] std::vector<std::string> names(const char* key) const {
    constexpr const char* accepted = "a list of columns in quotes";
    std::vector<std::string> result;
    const toml::node* node = file_.table.get(key);
    if (node == nullptr) return result;
    const toml::array* array = node->as_array();
    if (array == nullptr) refuse(key, *node, accepted);
    for (const toml::node& entry : *array) result.push_back(text(key, entry, accepted));
    return result;
  }
  [[nodiscard]] ExpectedEnd expected_end() const {
    const std::string word = text("expect");
    if (word == "completed") return ExpectedEnd::completed;
    if (word == "flagged") return ExpectedEnd::flagged;
    if (word == "stops") return ExpectedEnd::stops;
    file_.refuse(*file_.table.get("expect"), "\"{}\"; accepted: completed, flagged, stops", word);
  }

 private:
  [[noreturn]] void refuse(std::string_view key, const toml::node& node, const char* accepted) const {
    file_.refuse(node, "\"{}\" is {}; accepted: {}", key, shown(node), accepted);
  }
  [[nodiscard]] const toml::node& required(const char* key, const char* type) const {
    const toml::node* node = file_.table.get(key);
    if (node == nullptr) {
      throw InputError(fmt::format("{}: the criterion lacks {} \"{}\"", file_.name, type, key));
    }
    return *node;
  }
  [[nodiscard]] std::string text(std::string_view key, const toml::node& node, const char* accepted) const {
    const toml::value<std::string>* value = node.as_string();
    if (value == nullptr) refuse(key, node, accepted);
    return value->get();
  }
  [[nodiscard]] double number(std::string_view key, const toml::node& node) const {
    const std::optional<double> value = number_of(node);
    if (!value || !std::isfinite(*value)) refuse(key, node, "a finite number");
    return *value;
  }

  TomlFile file_;
};

}  // namespace

StabilityCase read_stability_case(const std::filesystem::path& path) {
  StabilityCase result;
  result.scene = read_scene(path);
  const Criterion criterion(path);
  result.name = path.stem().string();
  result.family = criterion.text("family");
  result.short_end_time = criterion.number("short_end_time");
  result.expect = criterion.expected_end();
  result.most = criterion.bounds("most");
  result.falls = criterion.names("falls");
  result.steady = criterion.bounds("steady");
  constexpr double largest_drift = 1e-6;
  for (const char* drift : {"area_drift", "volume_drift"}) {
    const auto same = [&](const ColumnBound& bound) { return bound.column == drift; };
    if (std::none_of(result.most.begin(), result.most.end(), same)) result.most.push_back({drift, largest_drift});
  }
  return result;
}

}  // namespace vehd

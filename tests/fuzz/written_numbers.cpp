#include "tests/fuzz/written_numbers.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "bie/scene/schema.hpp"
#include "bie/scene/units.hpp"

namespace fuzz {
namespace {

struct WrittenNumber {
  double value = 0.0;
  std::string unit;  ///< empty for a plain number
};

bool is_letter_of_key(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '-' || letter == '.';
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

/// A text that is a TOML number in any notation; nullopt for other texts and for nan and inf, which no scene holds.
std::optional<double> number_in(std::string text) {
  std::erase(text, '_');
  if (text.size() > 2 && text[0] == '0' && std::isalpha(static_cast<unsigned char>(text[1])) != 0 && text[1] != 'e' &&
      text[1] != 'E') {
    const int base = text[1] == 'x' ? 16 : text[1] == 'o' ? 8 : 2;
    return static_cast<double>(std::strtoull(text.c_str() + 2, nullptr, base));
  }
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return *end == '\0' ? std::optional<double>(value) : std::nullopt;
}

/// Reads one value: a number, a text in quotes, or a list of values, all on one line.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {}

  /// nullopt unless the line holds nothing but numbers, with or without units, and a comment.
  std::optional<std::vector<WrittenNumber>> numbers() {
    std::vector<WrittenNumber> result;
    if (!value(result)) return std::nullopt;
    skip_blanks();
    if (at_ < text_.size() && text_[at_] != '#') return std::nullopt;
    return result;
  }

 private:
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\r", at_), text_.size()); }
  bool take(char letter) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != letter) return false;
    ++at_;
    return true;
  }
  bool value(std::vector<WrittenNumber>& result) {
    if (take('[')) return list(result);
    if (take('"')) return quoted(result, '"');
    if (take('\'')) return quoted(result, '\'');
    const std::size_t end = std::min(text_.find_first_of(" \t\r,]#", at_), text_.size());
    const auto number = number_in(text_.substr(at_, end - at_));
    at_ = end;
    if (!number) return false;
    result.push_back({*number, ""});
    return true;
  }
  bool list(std::vector<WrittenNumber>& result) {
    while (!take(']')) {
      if (!value(result)) return false;
      if (take(',')) continue;
      return take(']');
    }
    return true;
  }
  bool quoted(std::vector<WrittenNumber>& result, char quote) {
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string::npos) return false;
    const std::string inside = trimmed(text_.substr(at_, end - at_));
    at_ = end + 1;
    const std::size_t number_end = std::min(inside.find_first_not_of("0123456789+-.eE"), inside.size());
    const auto number = number_in(inside.substr(0, number_end));
    if (!number || inside.find('\\') != std::string::npos) return false;
    result.push_back({*number, trimmed(inside.substr(number_end))});
    return true;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

std::vector<double> numbers_of(const vehd::Value& value) {
  struct Numbers {
    std::vector<double> operator()(bool) const { return {}; }
    std::vector<double> operator()(std::int64_t number) const { return {static_cast<double>(number)}; }
    std::vector<double> operator()(double number) const { return {number}; }
    std::vector<double> operator()(const std::string&) const { return {}; }
    std::vector<double> operator()(const vehd::Triple& numbers) const { return {numbers.begin(), numbers.end()}; }
    std::vector<double> operator()(const vehd::AxisAngle& numbers) const { return {numbers.begin(), numbers.end()}; }
    std::vector<double> operator()(const std::vector<double>& numbers) const { return numbers; }
    std::vector<double> operator()(const vehd::TripleOfTriples& rows) const {
      std::vector<double> result;
      for (const vehd::Triple& row : rows) result.insert(result.end(), row.begin(), row.end());
      return result;
    }
    std::vector<double> operator()(const std::vector<vehd::HarmonicMode>&) const { return {}; }
    std::vector<double> operator()(const std::vector<vehd::OutputWindow>&) const { return {}; }
  };
  return std::visit(Numbers{}, value);
}

/// Whether a value of the scene is the written one; with a unit up to the rounding of the reference scale.
bool is_same(const WrittenNumber& written, double value, const vehd::KeyDescription& key, const vehd::Scene& scene) {
  if (written.unit.empty()) return value == written.value;
  const vehd::Dimension* dimension = vehd::find_dimension(key.unit);
  const vehd::Unit* unit = dimension == nullptr ? nullptr : dimension->find(written.unit);
  if (unit == nullptr) return true;  // another spelling of a unit, such as µm
  const double kelvin = unit->per_kelvin ? scene.units->temperature.value() : 1.0;
  const double expected = written.value * unit->times / unit->over * kelvin;
  const double scale =
      key.type == vehd::ValueType::quantity ? 1.0 : vehd::reference_scale(*scene.units, *dimension).value_or(1.0);
  constexpr double rounding = 1e-12;
  // Products beyond the range of normal numbers lose digits wherever they are rounded.
  const auto is_normal = [](double number) { return number == 0.0 || std::isnormal(number); };
  if (!is_normal(expected) || !is_normal(scale) || !is_normal(value) || !is_normal(value * scale)) return true;
  return std::abs(value * scale - expected) <= rounding * std::abs(expected);
}

void compare(const vehd::KeyDescription& key, const std::vector<WrittenNumber>& written, const vehd::Scene& scene) {
  const auto value = key.get(scene);
  const std::vector<double> read = value ? numbers_of(*value) : std::vector<double>();
  bool same = read.size() == written.size();
  for (std::size_t i = 0; same && i < read.size(); ++i) same = is_same(written[i], read[i], key, scene);
  if (!same) throw std::logic_error(fmt::format("{}.{} is not the number that is written", key.table, key.name));
}

}  // namespace

void require_written_numbers(const std::string& text, const vehd::Scene& scene) {
  // Lines inside long texts only look like keys.
  if (text.find("\"\"\"") != std::string::npos || text.find("'''") != std::string::npos) return;
  std::istringstream lines(text);
  std::string table;
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    if (line.starts_with('[')) {
      const std::size_t end = line.find(']');
      table = end == std::string::npos ? "" : trimmed(line.substr(1, end - 1));
      continue;
    }
    const std::size_t sign = line.find('=');
    if (sign == std::string::npos) continue;
    const std::string name = trimmed(line.substr(0, sign));
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_letter_of_key)) continue;
    const auto is_table = [&](const vehd::TableDescription& each) { return each.name == table && each.present(scene); };
    if (std::none_of(vehd::scene_tables().begin(), vehd::scene_tables().end(), is_table)) continue;
    const vehd::KeyDescription* key = vehd::find_key_of_kind(table, name, vehd::kind_of(scene, table));
    if (key == nullptr || key->unit.empty() || key->type == vehd::ValueType::modes ||
        key->type == vehd::ValueType::windows) {
      continue;
    }
    const std::string value = line.substr(sign + 1);
    if (const auto written = Scanner(value).numbers()) compare(*key, *written, scene);
  }
}

}  // namespace fuzz

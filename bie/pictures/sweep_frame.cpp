#include "bie/pictures/sweep_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/shown_numbers.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/csv.hpp"

namespace vehd {
namespace {

/// Numbers of one unit.
struct KeyNumbers {
  std::vector<double> values;
  std::string unit;
};

std::optional<KeyNumbers> numbers_of(const std::vector<std::string>& texts) {
  KeyNumbers numbers;
  for (const std::string& text : texts) {
    const auto quantity = parse_quantity(text);
    if (!quantity || !std::isfinite(quantity->number)) return std::nullopt;
    if (!numbers.values.empty() && quantity->unit != numbers.unit) return std::nullopt;
    numbers.unit = quantity->unit;
    numbers.values.push_back(quantity->number);
  }
  return numbers;
}

/// The component in which vectors or lists differ, if it is one, [0, 0, "2 V/cm"] as 2 V/cm; otherwise the values as
/// they are.
std::vector<std::string> without_constant_components(const std::vector<std::string>& values) {
  std::vector<std::vector<std::string>> vectors;
  for (std::string text : values) {
    if (!text.starts_with('[')) return values;
    std::erase_if(text, [](char letter) { return std::string_view("[]{}\"").find(letter) != std::string_view::npos; });
    std::istringstream parts(text);
    vectors.emplace_back();
    for (std::string part; std::getline(parts >> std::ws, part, ',');) vectors.back().push_back(part);
    if (vectors.back().size() != vectors.front().size()) return values;
  }
  std::vector<std::vector<std::string>> varied;
  for (std::size_t k = 0; !vectors.empty() && k < vectors.front().size(); ++k) {
    std::vector<std::string> component;
    for (const auto& vector : vectors) component.push_back(vector[k]);
    if (std::ranges::count(component, component.front()) < std::ssize(component)) varied.push_back(component);
  }
  return varied.size() == 1 ? varied.front() : values;
}

/// @param of_one_unit  whether the axis has the unit
std::string tick_text(const std::string& value, bool of_one_unit) {
  const auto quantity = of_one_unit ? parse_quantity(value) : std::nullopt;
  return quantity ? fmt::format("{:.3g}", quantity->number) : gnuplot_literal(value);
}

/// Few enough to be legible.
constexpr std::size_t most_ticks = 6;

std::string label_of(const std::string& key, const std::optional<KeyNumbers>& numbers) {
  return with_unit(key_label(key), numbers ? numbers->unit : "");
}

SweepAxis side_by_side(const std::string& label, const std::vector<std::string>& values, bool of_one_unit) {
  SweepAxis axis{label, {}, {}};
  constexpr std::size_t long_text = 6;
  const bool has_long_texts = std::ranges::any_of(
      values, [&](const std::string& value) { return tick_text(value, of_one_unit).size() > long_text; });
  const std::size_t most = has_long_texts ? most_ticks / 2 : most_ticks;
  const std::size_t every = (values.size() + most - 1) / most;
  for (std::size_t i = 0; i < values.size(); ++i) {
    axis.places.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(values.size()));
    if (i % every == 0) axis.ticks.push_back({axis.places.back(), tick_text(values[i], of_one_unit)});
  }
  return axis;
}

/// @param lower, upper  powers of ten at the ends of the axis
SweepAxis by_logarithm(const std::string& label, const std::vector<double>& values, double lower, double upper) {
  const auto place = [&](double value) { return (std::log10(value) - lower) / (upper - lower); };
  SweepAxis axis{label, {}, {}};
  for (const double value : values) axis.places.push_back(place(value));
  constexpr double rounding = 1e-9;
  const auto first = static_cast<int>(std::ceil(lower - rounding)),
             last = static_cast<int>(std::floor(upper + rounding));
  const int every = std::max(1, (last - first + static_cast<int>(most_ticks)) / static_cast<int>(most_ticks));
  if (last > first) {
    std::vector<int> powers;
    for (int power = first; power <= last; power += every) powers.push_back(power);
    const std::vector<std::string> texts = power_texts(powers);
    for (std::size_t i = 0; i < powers.size(); ++i) {
      axis.ticks.push_back({place(std::pow(10.0, powers[i])), texts[i]});
    }
  } else {
    const std::size_t step = (values.size() + most_ticks - 1) / most_ticks;
    for (std::size_t i = 0; i < values.size(); i += step) {
      axis.ticks.push_back({axis.places[i], fmt::format("{:.3g}", values[i])});
    }
  }
  return axis;
}

SweepAxis between(const std::string& label, const std::vector<double>& values, double lower, double upper) {
  SweepAxis axis{label, {}, {}};
  for (const double value : values) axis.places.push_back((value - lower) / (upper - lower));
  const std::vector<double> ticks = round_ticks(lower, upper, 4);
  int power = 0;
  const std::vector<std::string> texts = tick_texts(ticks, power);
  for (std::size_t i = 0; i < ticks.size(); ++i) axis.ticks.push_back({(ticks[i] - lower) / (upper - lower), texts[i]});
  if (power != 0) axis.label += fmt::format(" / 10^{{{}}}", power);
  return axis;
}

/// Do values rise in even steps, to the digits that a table may have lost?
bool are_even(const std::vector<double>& values) {
  if (values.size() < 2) return false;
  constexpr double lost = 0.01;
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    if (!(std::abs(values[i + 1] - values[i] - step) <= lost * step)) return false;
  }
  return step > 0.0;
}

}  // namespace

SweepAxis axis_of_values(const std::string& key, const std::vector<std::string>& written, bool is_logarithmic) {
  const std::vector<std::string> values = without_constant_components(written);
  const auto numbers = numbers_of(values);
  const std::string label = label_of(key, numbers);
  if (!numbers || numbers->values.empty()) return side_by_side(label, values, numbers.has_value());
  const auto [least, most] = std::ranges::minmax(numbers->values);
  if (!(most > least)) return side_by_side(label, values, numbers.has_value());
  if (is_logarithmic && least > 0.0) {
    return by_logarithm(label, numbers->values, std::log10(least), std::log10(most));
  }
  return between(label, numbers->values, least, most);
}

SweepAxis axis_of_cells(const std::string& key, const std::vector<std::string>& written) {
  const std::vector<std::string> values = without_constant_components(written);
  const auto numbers = numbers_of(values);
  const std::string label = label_of(key, numbers);
  if (!numbers || values.size() <= most_ticks) return side_by_side(label, values, numbers.has_value());
  const std::vector<double>& even = numbers->values;
  // From the outer edge of the first cell to that of the last one.
  const double half = 0.5 / static_cast<double>(even.size() - 1);
  const auto ends = [half](double first, double last) {
    return std::pair(first - half * (last - first), last + half * (last - first));
  };
  if (are_even(even)) {
    const auto [lower, upper] = ends(even.front(), even.back());
    return between(label, even, lower, upper);
  }
  std::vector<double> powers;
  for (const double value : even) powers.push_back(std::log10(value));
  if (!are_even(powers)) return side_by_side(label, values, numbers.has_value());
  const auto [lower, upper] = ends(powers.front(), powers.back());
  return by_logarithm(label, even, lower, upper);
}

SweepAxis axis_of_numbers(const std::string& label, const std::vector<double>& values) {
  const auto [least, most] = finite_range(values);
  if (!std::isfinite(least)) return {label, values, {}};
  constexpr double room = 0.06;
  const double constant = room_around_constant(least, most);
  const double about = constant > 0.0 ? constant : room * (most - least);
  return between(label, values, least - about, most + about);
}

namespace {

constexpr double sweep_panel_width = 255.0, sweep_panel_height = 172.0;

constexpr double sweep_text = 8.0, sweep_tick = 3.0;

/// An area, because lines would be drawn above the points.
void draw_pale_line(Page& page, const Box& line) { page.areas.push_back({line.corners(), "#e4e4e4"}); }

}  // namespace

SweepPanels::SweepPanels(std::size_t count) : across_(count > 1 ? 2 : 1) {
  const std::size_t down = (count + across_ - 1) / across_;
  page.width = sweep_panel_width * static_cast<double>(across_);
  page.height = sweep_panel_height * static_cast<double>(down);
}

Box SweepPanels::box(std::size_t panel) const {
  const double left = sweep_panel_width * static_cast<double>(panel % across_);
  const double top = page.height - sweep_panel_height * static_cast<double>(panel / across_);
  return {left + 46.0, top - sweep_panel_height + 34.0, left + sweep_panel_width - 16.0, top - 24.0};
}

PageArea sweep_dot(const PagePoint& at, const char* colour) {
  constexpr double radius = 1.7;
  PageArea area{{}, colour};
  for (int i = 0; i < 8; ++i) {
    const double angle = std::numbers::pi / 4.0 * (i + 0.5);
    area.points.push_back({at[0] + radius * std::cos(angle), at[1] + radius * std::sin(angle)});
  }
  return area;
}

std::string column_label(const std::string& header) {
  const auto [name, unit] = header_parts(header);
  return with_unit(column_title(name), unit);
}

void draw_sweep_frame(Page& page, const Box& box, const SweepAxis& x, const SweepAxis& y, bool grid) {
  for (const SweepTick& tick : x.ticks) {
    const double place = box.left + tick.place * box.width();
    if (grid) draw_pale_line(page, {place - 0.25, box.bottom, place + 0.25, box.top});
    page.lines.push_back({{{place, box.bottom}, {place, box.bottom - sweep_tick}}, 0.5, "#000000", false});
    page.texts.push_back({tick.text, {place, box.bottom - 9.0}, sweep_text, TextAnchor::centre, "#000000"});
  }
  for (const SweepTick& tick : y.ticks) {
    const double place = box.bottom + tick.place * box.height();
    if (grid) draw_pale_line(page, {box.left, place - 0.25, box.right, place + 0.25});
    page.lines.push_back({{{box.left, place}, {box.left - sweep_tick, place}}, 0.5, "#000000", false});
    page.texts.push_back({tick.text, {box.left - sweep_tick - 2.0, place}, sweep_text, TextAnchor::right, "#000000"});
  }
  page.lines.push_back(frame_of(box, 0.6, "#000000"));
  page.texts.push_back(
      {x.label, {0.5 * (box.left + box.right), box.bottom - 23.0}, sweep_text, TextAnchor::centre, "#000000"});
  page.texts.push_back({y.label, {box.left - 30.0, box.top + 10.0}, sweep_text, TextAnchor::left, "#000000"});
}

}  // namespace vehd

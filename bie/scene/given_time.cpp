#include "bie/scene/given_time.hpp"

#include <fmt/format.h>

#include "bie/scene/units.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

std::string problem_of_time(const std::string& text) {
  const Dimension& dimension = *find_dimension("time");
  const auto quantity = parse_quantity(text);
  if (quantity && (quantity->unit.empty() || dimension.find(quantity->unit) != nullptr)) return {};
  return fmt::format("\"{}\" is not a time; accepted: a number, or one with a unit ({}), as \"0.5 ms\"", text,
                     dimension.accepted());
}

double number_of_time(const std::string& text, const std::optional<UnitsScene>& scales,
                      const std::optional<OutputUnit>& plain) {
  if (const std::string problem = problem_of_time(text); !problem.empty()) throw InputError(problem);
  const Quantity quantity = *parse_quantity(text);
  if (quantity.number == 0.0) return 0.0;
  if (quantity.unit.empty()) {
    if (plain) return quantity.number / plain->factor;
    throw InputError(
        fmt::format("the time {} has no unit, and no history.csv beside the run says which one its times "
                    "have; accepted: as in \"{} ms\"",
                    text, text));
  }
  if (!scales || !scales->time) {
    throw InputError(
        fmt::format("the time \"{}\" has a unit, but the scene has no unit of time; accepted: a number", text));
  }
  return quantity.in_si(*find_dimension("time")->find(quantity.unit)) / *scales->time;
}

}  // namespace vehd

#include "bie/scene/reference_time.hpp"

#include <algorithm>
#include <array>

#include "bie/scene/units.hpp"

namespace vehd {
namespace {

class Shortest {
 public:
  /// A product or quotient of values, some of which may be absent or out of range, is no time then.
  void add(std::optional<double> time) {
    if (time && *time > 0.0 && has_magnitude_in_range(*time)) shortest_ = std::min(shortest_.value_or(*time), *time);
  }
  [[nodiscard]] std::optional<double> value() const { return shortest_; }

 private:
  std::optional<double> shortest_;
};

std::optional<double> product(std::initializer_list<std::optional<double>> factors) {
  double result = 1.0;
  for (const auto& factor : factors) {
    if (!factor) return std::nullopt;
    result *= *factor;
  }
  return result;
}

std::optional<double> inverse(std::optional<double> value) {
  return value ? std::optional<double>(1.0 / *value) : std::nullopt;
}

std::optional<double> sum(std::optional<double> a, std::optional<double> b) {
  return a && b ? std::optional<double>(*a + *b) : std::nullopt;
}

void add_waveform(Shortest& times, const SiValues& si, std::string_view table) {
  times.add(si.size(table, "duration"));
  times.add(si.size(table, "period"));
  if (!si.is_true(table, "average")) times.add(inverse(si.size(table, "frequency")));
}

void add_flow(Shortest& times, const SiValues& si) {
  times.add(inverse(si.size("flow", "rate")));
  times.add(inverse(si.size("flow", "gradient")));
  times.add(product({si.size("flow", "radius"), inverse(si.size("flow", "centre_velocity"))}));
}

void add_electric(Shortest& times, const SiValues& si, const UnitsScene& units) {
  if (!si.has_table("electric")) return;
  const auto inside = inverse(si.size("electric", "conductivity_in"));
  const auto outside = product({0.5, inverse(si.size("electric", "conductivity_out"))});
  times.add(product({units.length, si.size("membrane", "capacitance"), sum(inside, outside)}));
  const auto field = inverse(si.size("electric", "field"));
  times.add(product({units.viscosity, inverse(si.size("electric", "permittivity")), field, field}));
}

}  // namespace

std::optional<double> shortest_time(const SiValues& si, const UnitsScene& units) {
  Shortest times;
  add_waveform(times, si, "flow.waveform");
  add_waveform(times, si, "electric.waveform");
  add_flow(times, si);
  add_electric(times, si, units);
  const auto& length = units.length;
  times.add(product({units.viscosity, length, length, length, inverse(si.size("membrane", "bending_modulus"))}));
  return times.value();
}

}  // namespace vehd

#include "bie/scene/output_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "bie/scene/units.hpp"

namespace vehd {
namespace {

struct Prefix {
  std::string_view symbol;
  double times = 1.0;  ///< of the unit without it, as a ratio of two exact numbers
  double over = 1.0;
};
constexpr std::array prefixes = {Prefix{"M", 1e6},     Prefix{"k", 1e3},    Prefix{""},           Prefix{"m", 1, 1e3},
                                 Prefix{"u", 1, 1e6},  Prefix{"n", 1, 1e9}, Prefix{"p", 1, 1e12}, Prefix{"f", 1, 1e15},
                                 Prefix{"a", 1, 1e18}, Prefix{"z", 1, 1e21}};

/// Dimensions whose unit is a power of that of another.
struct PowerOf {
  std::string_view dimension, base;
  int power;
};
constexpr std::array powers = {PowerOf{"area", "length", 2}, PowerOf{"length^2", "length", 2},
                               PowerOf{"volume", "length", 3}};
/// The other dimensions that results have.
constexpr std::array<std::string_view, 11> plain_dimensions = {
    "length",       "time",       "velocity", "potential", "dipole", "potential/length",
    "force/length", "force/area", "energy",   "power",     "force"};

/// Dimensions that have their SI unit as it is.
constexpr std::array<std::string_view, 4> unprefixed_dimensions = {"conductance/area", "capacitance/area",
                                                                   "current/area", "1/area"};

int power_of(std::string_view dimension) {
  const auto found = std::ranges::find(powers, dimension, &PowerOf::dimension);
  return found == powers.end() ? 1 : found->power;
}

/// Symbol with the largest prefix of which there is at least one; that of rounding below one counts.
std::string suitable_symbol(const Dimension& dimension, double magnitude) {
  constexpr double rounding = 1e-9;
  const auto fits = [&](const Prefix& prefix) { return magnitude * prefix.over >= prefix.times * (1.0 - rounding); };
  const auto found = std::ranges::find_if(prefixes, fits);
  const Prefix& prefix = found == prefixes.end() ? prefixes.back() : *found;
  return std::string(prefix.symbol) + std::string(dimension.si_unit());
}

/// What the symbol is in SI base units, as a ratio; nullopt if it is no unit of the dimension.
std::optional<std::array<double, 2>> size_of_unit(const Dimension& dimension, std::string_view symbol) {
  if (std::ranges::find(unprefixed_dimensions, dimension.name) != unprefixed_dimensions.end()) {
    return symbol == dimension.si_unit() ? std::optional(std::array{1.0, 1.0}) : std::nullopt;
  }
  for (const Prefix& prefix : prefixes) {
    if (symbol != std::string(prefix.symbol) + std::string(dimension.si_unit())) continue;
    const int power = power_of(dimension.name);
    return std::array{std::pow(prefix.times, power), std::pow(prefix.over, power)};
  }
  return std::nullopt;
}

double length_of(const Triple& t) { return std::hypot(t[0], t[1], t[2]); }

/// About how large the quantities of a run become, in SI units; NaN where the scene does not say.
class Magnitudes {
 public:
  explicit Magnitudes(const Scene& scene) : scene_(scene) {}

  [[nodiscard]] double of(std::string_view dimension) const {
    if (dimension == "length") return radius();
    if (dimension == "time") return duration();
    if (dimension == "velocity") return radius() / duration();
    if (dimension == "potential") return field() > 0.0 ? 1.5 * field() * radius() : si(1.0, "potential");
    if (dimension == "potential/length") return field() > 0.0 ? field() : si(1.0, "field");
    if (dimension == "force/length") return tension();
    if (dimension == "force/area") return tension() / radius();
    if (dimension == "force") return tension() * radius();
    if (dimension == "energy") return tension() * radius() * radius();
    if (dimension == "power") return tension() * radius() * radius() / duration();
    if (dimension == "dipole") return dipole();
    return si(1.0, dimension);
  }

 private:
  [[nodiscard]] double si(double value, std::string_view dimension) const {
    return value * si_scale(scene_.units, dimension);
  }

  /// Of the initial shape. That of a file is not looked up for the choice of a prefix.
  [[nodiscard]] double radius() const {
    const ShapeScene& shape = scene_.shape;
    if (shape.area) return si(std::sqrt(*shape.area / (4.0 * std::numbers::pi)), "length");
    double size = 1.0;
    if (shape.kind == ShapeKind::ellipsoid) size = std::cbrt(shape.axes[0] * shape.axes[1] * shape.axes[2]);
    if (shape.kind == ShapeKind::radial) size = std::max(std::abs(shape.base), std::abs(shape.amplitude.value_or(0.0)));
    return si(size * shape.scale.value_or(1.0), "length");
  }

  [[nodiscard]] double duration() const {
    const double end = scene_.numerics.end_time;
    return si(end > 0.0 ? end : 1.0, "time");
  }

  [[nodiscard]] double field() const { return scene_.electric ? si(length_of(scene_.electric->field), "field") : 0.0; }

  [[nodiscard]] double dipole() const {
    if (!(field() > 0.0)) return si(1.0, "dipole");
    return si(scene_.electric->permittivity, "permittivity") * field() * std::pow(radius(), 3);
  }

  /// Of bending, flow and field, whichever gives most.
  [[nodiscard]] double tension() const {
    double most = 0.0;
    const auto consider = [&](double value) { most = std::fmax(most, value); };
    consider(si(scene_.membrane.bending_modulus.value_or(0.0), "energy") / (radius() * radius()));
    if (scene_.electric) consider(si(scene_.electric->permittivity, "permittivity") * field() * field() * radius());
    if (scene_.flow) consider(si(scene_.fluid.viscosity, "viscosity") * shear_rate() * radius());
    return most > 0.0 ? most : si(1.0, "force/length");
  }

  [[nodiscard]] double shear_rate() const {
    const FlowScene& flow = *scene_.flow;
    if (flow.kind == FlowKind::poiseuille) {
      return 2.0 * std::abs(si(flow.centre_velocity, "velocity")) * radius() / std::pow(si(flow.radius, "length"), 2);
    }
    if (flow.kind != FlowKind::gradient) return std::abs(si(flow.rate, "1/time"));
    double most = 0.0;
    for (const Triple& row : flow.gradient) most = std::max(most, length_of(row));
    return si(most, "1/time");
  }

  const Scene& scene_;
};

bool wants_si(const Scene& scene) { return scene.units && scene.output.units != ResultUnits::dimensionless; }

}  // namespace

std::string OutputUnit::text_of(double number) const {
  const std::string text = fmt::format("{:g}", number * factor);
  return is_si() ? text + " " + symbol : text;
}

OutputUnits::OutputUnits(const Scene& scene) : scales_(scene.units) {
  if (!wants_si(scene)) return;
  const Magnitudes magnitudes(scene);
  for (const std::string_view name : plain_dimensions) {
    const double magnitude = magnitudes.of(name);
    if (!std::isfinite(si_scale(scales_, name)) || !std::isfinite(magnitude)) continue;
    symbols_.emplace(name, suitable_symbol(*find_dimension(name), magnitude));
  }
  for (const std::string_view name : unprefixed_dimensions) {
    if (std::isfinite(si_scale(scales_, name))) symbols_.emplace(name, find_dimension(name)->si_unit());
  }
  for (const PowerOf& dimension : powers) {
    const auto base = symbols_.find(dimension.base);
    if (base == symbols_.end()) continue;
    symbols_.emplace(dimension.dimension, fmt::format("{}^{}", base->second, dimension.power));
  }
}

OutputUnits::OutputUnits(std::optional<UnitsScene> scales, std::map<std::string, std::string, std::less<>> symbols)
    : scales_(std::move(scales)), symbols_(std::move(symbols)) {}

OutputUnit OutputUnits::of(std::string_view dimension) const {
  const auto symbol = symbols_.find(dimension);
  const Dimension* known = find_dimension(dimension);
  if (symbol == symbols_.end() || known == nullptr) return {};
  const auto size = size_of_unit(*known, symbol->second);
  const double scale = si_scale(scales_, dimension);
  if (!size || !std::isfinite(scale)) return {};
  return {symbol->second, scale * (*size)[1] / (*size)[0]};
}

std::string si_number(double value, std::string_view dimension) {
  const Dimension& known = *find_dimension(dimension);
  const std::string symbol = suitable_symbol(known, std::abs(value));
  const auto size = size_of_unit(known, symbol);
  return fmt::format("{:.4g} {}", value * (*size)[1] / (*size)[0], symbol);
}

std::string printed_unit(std::string_view symbol) {
  std::string text;
  for (std::size_t at = 0; at < symbol.size(); ++at) {
    const std::string_view rest = symbol.substr(at);
    if (rest.starts_with("^2") || rest.starts_with("^3")) {
      text += rest[1] == '2' ? "²" : "³";
      ++at;
    } else if (at == 0 && rest[0] == 'u') {
      // No unit of results but the prefix begins so.
      text += "µ";
    } else {
      text += rest[0];
    }
  }
  return text;
}

std::string with_unit(std::string_view label, std::string_view symbol) {
  return symbol.empty() ? std::string(label) : fmt::format("{} ({})", label, printed_unit(symbol));
}

}  // namespace vehd

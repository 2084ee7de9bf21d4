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

/// Symbol with the largest prefix of which there is at least one; that of rounding below one counts.
std::string suitable_symbol(const Dimension& dimension, double magnitude) {
  constexpr double rounding = 1e-9;
  const auto fits = [&](const Prefix& prefix) { return magnitude * prefix.over >= prefix.times * (1.0 - rounding); };
  const auto found = std::ranges::find_if(prefixes, fits);
  const Prefix& prefix = found == prefixes.end() ? prefixes.back() : *found;
  return fmt::format("{}{}", prefix.symbol, dimension.si_unit());
}

/// A number in SI base units as one in the unit of that symbol; NaN if it is no unit of the dimension.
double in_unit(double value, const Dimension& dimension, std::string_view symbol) {
  for (const Prefix& prefix : prefixes) {
    if (dimension.result_power == 0 && !prefix.symbol.empty()) continue;
    if (symbol != fmt::format("{}{}", prefix.symbol, dimension.si_unit())) continue;
    return value * std::pow(prefix.over, dimension.result_power) / std::pow(prefix.times, dimension.result_power);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double length_of(const Triple& t) { return std::hypot(t[0], t[1], t[2]); }

/// About how large the quantities of a run become, in SI units; NaN where the scene does not say.
class Magnitudes {
 public:
  explicit Magnitudes(const Scene& scene)
      : scene_(scene), field_(scene.electric ? si(length_of(scene.electric->field), "field") : 0.0) {
    // That of a shape file is not looked up for the choice of a prefix.
    const ShapeScene& shape = scene.shape;
    double size = shape.scale.value_or(1.0);
    if (shape.kind == ShapeKind::ellipsoid) size *= std::cbrt(shape.axes[0] * shape.axes[1] * shape.axes[2]);
    if (shape.kind == ShapeKind::radial)
      size *= std::max(std::abs(shape.base), std::abs(shape.amplitude.value_or(0.0)));
    radius_ = si(shape.area ? std::sqrt(*shape.area / (4.0 * std::numbers::pi)) : size, "length");
    duration_ = si(scene.numerics.end_time > 0.0 ? scene.numerics.end_time : 1.0, "time");
    // Of bending, flow and field, whichever gives most.
    tension_ = std::fmax(0.0, si(scene.membrane.bending_modulus.value_or(0.0), "energy") / (radius_ * radius_));
    if (scene.electric) tension_ = std::fmax(tension_, permittivity() * field_ * field_ * radius_);
    if (scene.flow) tension_ = std::fmax(tension_, si(scene.fluid.viscosity, "viscosity") * shear_rate() * radius_);
    if (!(tension_ > 0.0)) tension_ = si(1.0, "force/length");
  }

  [[nodiscard]] double of(const Dimension& dimension) const {
    const bool has_field = field_ > 0.0;
    if (dimension.name == "potential") return has_field ? 1.5 * field_ * radius_ : si(1.0, "potential");
    if (dimension.name == "potential/length") return has_field ? field_ : si(1.0, "field");
    if (dimension.name == "dipole") {
      return has_field ? permittivity() * field_ * std::pow(radius_, 3) : si(1.0, "dipole");
    }
    // Mechanical ones follow from a length, a time and a tension, whose dimension is L T^-1 M.
    const auto& [length, time, viscosity, none] = dimension.powers;
    return std::pow(radius_, length - viscosity) * std::pow(duration_, time + viscosity) *
           std::pow(tension_, viscosity);
  }

 private:
  [[nodiscard]] double si(double value, std::string_view dimension) const {
    return value * si_scale(scene_.units, dimension);
  }

  [[nodiscard]] double permittivity() const { return si(scene_.electric->permittivity, "permittivity"); }

  [[nodiscard]] double shear_rate() const {
    const FlowScene& flow = *scene_.flow;
    if (flow.kind == FlowKind::poiseuille) {
      return 2.0 * std::abs(si(flow.centre_velocity, "velocity")) * radius_ / std::pow(si(flow.radius, "length"), 2);
    }
    double most = std::abs(flow.rate);
    if (flow.kind == FlowKind::gradient) {
      most = 0.0;
      for (const Triple& row : flow.gradient) most = std::max(most, length_of(row));
    }
    return si(most, "1/time");
  }

  const Scene& scene_;
  double field_, radius_ = 0.0, duration_ = 0.0, tension_ = 0.0;
};

}  // namespace

std::string OutputUnit::text_of(double number) const {
  const std::string text = fmt::format("{:g}", number * factor);
  return is_si() ? text + " " + symbol : text;
}

OutputUnits::OutputUnits(const Scene& scene) : scales_(scene.units) {
  if (!scene.units || scene.output.units == ResultUnits::dimensionless) return;
  const Magnitudes magnitudes(scene);
  for (const Dimension& dimension : dimensions()) {
    if (dimension.result_power < 0 || !std::isfinite(si_scale(scales_, dimension.name))) continue;
    // Areas and volumes have the unit of length, .
    const std::string_view of = dimension.result_power > 1 ? "length" : dimension.name;
    const double magnitude = magnitudes.of(*find_dimension(of));
    if (dimension.result_power == 0) {
      symbols_.emplace(dimension.name, dimension.si_unit());
    } else if (std::isfinite(magnitude)) {
      const std::string symbol = suitable_symbol(*find_dimension(of), magnitude);
      symbols_.emplace(dimension.name,
                       dimension.result_power == 1 ? symbol : fmt::format("{}^{}", symbol, dimension.result_power));
    }
  }
}

OutputUnits::OutputUnits(std::optional<UnitsScene> scales, std::map<std::string, std::string, std::less<>> symbols)
    : scales_(std::move(scales)), symbols_(std::move(symbols)) {}

OutputUnit OutputUnits::of(std::string_view dimension) const {
  const auto symbol = symbols_.find(dimension);
  const Dimension* known = find_dimension(dimension);
  if (symbol == symbols_.end() || known == nullptr) return {};
  const double factor = in_unit(si_scale(scales_, dimension), *known, symbol->second);
  return std::isfinite(factor) ? OutputUnit{symbol->second, factor} : OutputUnit{};
}

std::string si_number(double value, std::string_view dimension) {
  const Dimension& known = *find_dimension(dimension);
  const std::string symbol = suitable_symbol(known, std::abs(value));
  return fmt::format("{:.4g} {}", in_unit(value, known, symbol), symbol);
}

std::string quantity_text(const std::optional<UnitsScene>& units, double value, std::string_view dimension) {
  const double si = value * si_scale(units, dimension);
  return std::isnan(si) || si == 0.0 ? fmt::format("{:g}", value) : si_number(si, dimension);
}

std::string printed_unit(std::string_view symbol) {
  std::string text(symbol);
  // No unit of results but the prefix begins so.
  if (text.starts_with('u')) text.replace(0, 1, "µ");
  for (const auto& [written, printed] : {std::pair{"^2", "²"}, {"^3", "³"}}) {
    for (std::size_t at = text.find(written); at != std::string::npos; at = text.find(written)) {
      text.replace(at, 2, printed);
    }
  }
  return text;
}

std::string with_unit(std::string_view label, std::string_view symbol) {
  return symbol.empty() ? std::string(label) : fmt::format("{} ({})", label, printed_unit(symbol));
}

}  // namespace vehd

#include "bie/pictures/report/surface_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bie/pictures/report/packed_coefficients.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/surface_mesh.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {
namespace {

constexpr std::size_t most_surface_bytes = 8'000'000;
/// Extremes of a surface are read off a grid of this degree or of twice its own.
constexpr int least_extreme_grid = 31;
/// This share of the times may lie beyond the ends of the colours: what a field does in its first instants would leave
/// no colours for the rest.
constexpr double share_beyond = 0.05;
/// A field has both signs to look at where the smaller of its extremes has at least this share of the larger.
constexpr double least_other_sign = 0.1;

struct PageField {
  const char* name;  ///< in run.h5
  const char* label;
  const char* dimension;  ///< by its name in scene/units.hpp
  bool sign_matters;      ///< even where the values of a run have one sign alone
};
constexpr std::array page_fields = {PageField{"Vm", "V_m", "potential", true},
                                    PageField{"q", "q", "potential/length", true},
                                    PageField{"tension", "tension λ", "force/length", false}};

std::vector<std::size_t> evenly_spread(std::size_t n, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t count = std::min(n, std::max<std::size_t>(most, 2));
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? 0 : (i * (n - 1) + (count - 1) / 2) / (count - 1));
  }
  return chosen;
}

std::size_t n_components(const RunReader& run, std::size_t snapshot) {
  return 3 + static_cast<std::size_t>(std::ranges::count_if(
                 page_fields, [&](const PageField& field) { return run.has_field(snapshot, field.name); }));
}

Matrix values_of(const Matrix& coefficients) {
  const int order = order_of(coefficients.rows());
  const SphereTransform transform(order, make_grid(std::max(least_extreme_grid, 2 * order)));
  return with_poles(transform.synthesize(coefficients), coefficients);
}

/// One field at all times.
struct FieldOverTime {
  PackedCoefficients coefficients;
  std::vector<double> lowest, highest;

  void add(const Matrix& of_time) {
    coefficients.add(of_time);
    const Matrix values = values_of(of_time);
    lowest.push_back(values.minCoeff());
    highest.push_back(values.maxCoeff());
  }
};

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

nlohmann::json rounded_list(const std::vector<double>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const double value : values) list.push_back(rounded_for_page(value));
  return list;
}

nlohmann::json field_data(const PageField& field, const FieldOverTime& values, const std::string& unit) {
  // So that up to 1 / share_beyond times lose none of them.
  const double beyond = values.lowest.size() * share_beyond < 1.0 ? 0.0 : share_beyond;
  double lower = quantile(values.lowest, beyond), upper = quantile(values.highest, 1.0 - beyond);
  const double size = std::max(std::abs(lower), std::abs(upper));
  const bool has_both = lower < 0.0 && upper > 0.0 && std::min(-lower, upper) >= least_other_sign * size;
  const bool both_signs = field.sign_matters || has_both;
  if (both_signs) {
    lower = -size;
    upper = size;
  }
  // A field that is constant up to rounding has no scale of its own.
  if (upper - lower <= 1e-9 * size) {
    const double half = size > 0.0 ? size : 1.0;
    lower -= half;
    upper += half;
  }
  nlohmann::json json = values.coefficients.json();
  json["name"] = field.name;
  json["label"] = field.label;
  json["unit"] = unit;
  json["lowest"] = rounded_list(values.lowest);
  json["highest"] = rounded_list(values.highest);
  json["range"] = {rounded_for_page(lower), rounded_for_page(upper)};
  json["both_signs"] = both_signs;
  json["beyond"] = std::ranges::min(values.lowest) < lower || std::ranges::max(values.highest) > upper;
  return json;
}

}  // namespace

std::vector<std::size_t> snapshots_for_page(const RunReader& run, std::size_t most) {
  const std::vector<std::size_t> chosen = evenly_spread(run.times().size(), most);
  std::size_t bytes = 0;
  for (const std::size_t snapshot : chosen) {
    const int order = order_of(run.coefficients(snapshot, "x", 3).rows());
    bytes += n_components(run, snapshot) * packed_bytes(order);
  }
  if (bytes <= most_surface_bytes) return chosen;
  return evenly_spread(run.times().size(), chosen.size() * most_surface_bytes / bytes);
}

nlohmann::json surface_data(const RunReader& run, const std::vector<std::size_t>& snapshots, const OutputUnits& units) {
  nlohmann::json json;
  PackedCoefficients position;
  std::array<FieldOverTime, page_fields.size()> fields;
  double radius = 0.0;
  const OutputUnit time = units.of("time"), length = units.of("length");
  std::array<OutputUnit, page_fields.size()> field_units;
  for (std::size_t i = 0; i < page_fields.size(); ++i) field_units[i] = units.of(page_fields[i].dimension);
  for (const std::size_t snapshot : snapshots) {
    Matrix x = run.coefficients(snapshot, "x", 3) * length.factor;
    // The only harmonic whose mean over the sphere is not zero.
    x.row(0).setZero();
    position.add(x);
    const Matrix points = values_of(x);
    radius = std::max(radius, points.rowwise().norm().maxCoeff());
    const Eigen::RowVector3d extents = points.colwise().maxCoeff() - points.colwise().minCoeff();
    json["extents"].push_back(rounded_list({extents.begin(), extents.end()}));
    json["times"].push_back(rounded_for_page(run.times()[snapshot] * time.factor));
    json["degrees"].push_back(order_of(x.rows()));
    for (std::size_t i = 0; i < page_fields.size(); ++i) {
      if (!run.has_field(snapshot, page_fields[i].name)) continue;
      fields[i].add(run.coefficients(snapshot, page_fields[i].name, 1) * field_units[i].factor);
    }
  }
  json["position"] = position.json();
  json["radius"] = rounded_for_page(radius);
  json["unit"] = printed_unit(length.symbol);
  json["fields"] = nlohmann::json::array();
  for (std::size_t i = 0; i < page_fields.size(); ++i) {
    // A field of some times alone has no place on a slider through all of them.
    if (fields[i].lowest.size() != snapshots.size()) continue;
    json["fields"].push_back(field_data(page_fields[i], fields[i], printed_unit(field_units[i].symbol)));
  }
  return json;
}

}  // namespace vehd

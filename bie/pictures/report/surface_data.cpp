#include <algorithm>
#include <array>

#include "bie/geometry/surface.hpp"
#include "bie/pictures/colours.hpp"
#include "bie/pictures/report/packed_coefficients.hpp"
#include "bie/pictures/report/page_data.hpp"
#include "bie/pictures/shape_field.hpp"
#include "bie/pictures/shape_times.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/surface_mesh.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {
namespace {

constexpr std::size_t most_surface_bytes = 8'000'000;
/// Extremes of a surface are taken on a grid of this degree or twice its own, whichever is higher.
constexpr int least_extreme_grid = 31;
/// Fields by which the page can colour the vesicle.
constexpr std::array page_fields = {"V_m", "q", "tension"};

std::string dataset_of(const char* field) { return std::string(shape_field(field).datasets[0]); }

std::size_t n_components(const RunSnapshot& snapshot) {
  return 3 + static_cast<std::size_t>(std::ranges::count_if(
                 page_fields, [&](const char* field) { return snapshot.has_field(dataset_of(field)); }));
}

/// One field at all times.
struct FieldOverTime {
  PackedCoefficients coefficients;
  std::vector<FieldReach> reaches;

  void add(const Matrix& of_time, const SphereTransform& transform, const Vector& weights) {
    coefficients.add(of_time);
    const Vector values = transform.synthesize(of_time).col(0);
    FieldReach reach = reach_of(values, weights);
    // The poles are not points of the grid, but the extremes are often there.
    const Matrix all = with_poles(values, of_time);
    reach.least = all.minCoeff();
    reach.most = all.maxCoeff();
    reaches.push_back(reach);
  }
};

nlohmann::json field_data(const ShapeField& field, const FieldOverTime& values, const std::string& unit) {
  const ColourRange range = robust_range(values.reaches, field.sign_matters);
  nlohmann::json json = values.coefficients.json();
  json["name"] = field.datasets[0];
  json["label"] = field.text;
  json["unit"] = unit;
  for (const FieldReach& reach : values.reaches) {
    json["lowest"].push_back(rounded_for_page(reach.least));
    json["highest"].push_back(rounded_for_page(reach.most));
  }
  json["range"] = {rounded_for_page(range.lower), rounded_for_page(range.upper)};
  json["both_signs"] = range.both_signs;
  json["beyond"] = range.below || range.above;
  return json;
}

}  // namespace

std::vector<std::size_t> snapshots_for_page(const RunReader& run, std::size_t most) {
  const std::vector<std::size_t> chosen = spread_evenly(run.times().size(), std::max<std::size_t>(most, 2));
  std::size_t bytes = 0;
  for (const std::size_t number : chosen) {
    const RunSnapshot snapshot = run.snapshot(number);
    const int order = order_of(snapshot.coefficients("x", 3).rows());
    bytes += n_components(snapshot) * packed_bytes(order);
  }
  if (bytes <= most_surface_bytes) return chosen;
  return spread_evenly(run.times().size(), std::max<std::size_t>(2, chosen.size() * most_surface_bytes / bytes));
}

nlohmann::json surface_data(const RunReader& run, const std::vector<std::size_t>& snapshots, const OutputUnits& units,
                            const std::optional<Wall>& wall) {
  nlohmann::json json;
  PackedCoefficients position;
  std::array<FieldOverTime, page_fields.size()> fields;
  double radius = 0.0;
  const OutputUnit time = units.of("time"), length = units.of("length");
  std::array<OutputUnit, page_fields.size()> field_units;
  for (std::size_t i = 0; i < page_fields.size(); ++i) field_units[i] = units.of(shape_field(page_fields[i]).dimension);
  for (const std::size_t number : snapshots) {
    const RunSnapshot snapshot = run.snapshot(number);
    Matrix x = snapshot.coefficients("x", 3);
    if (wall) {
      const double height = wall->height(mean_vector(x));
      json["wall"]["heights"].push_back(rounded_for_page(height * length.factor));
    }
    x *= length.factor;
    // The only harmonic whose mean over the sphere is not zero.
    x.row(0).setZero();
    position.add(x);
    const int order = order_of(x.rows());
    const SphereTransform transform(order, make_grid(std::max(least_extreme_grid, 2 * order)));
    const Surface surface = make_surface(transform, x);
    const Matrix points = with_poles(surface.position, x);
    radius = std::max(radius, points.rowwise().norm().maxCoeff());
    const Eigen::RowVector3d extents = points.colwise().maxCoeff() - points.colwise().minCoeff();
    json["extents"].push_back(rounded_for_page(std::vector<double>(extents.begin(), extents.end())));
    json["times"].push_back(rounded_for_page(snapshot.time() * time.factor));
    json["degrees"].push_back(order);
    for (std::size_t i = 0; i < page_fields.size(); ++i) {
      const std::string dataset = dataset_of(page_fields[i]);
      if (!snapshot.has_field(dataset)) continue;
      fields[i].add(snapshot.coefficients(dataset, 1) * field_units[i].factor, transform, surface.quadrature);
    }
  }
  if (wall) json["wall"]["normal"] = rounded_for_page(std::vector<double>(wall->normal.begin(), wall->normal.end()));
  json["position"] = position.json();
  json["radius"] = rounded_for_page(radius);
  json["unit"] = printed_unit(length.symbol);
  json["fields"] = nlohmann::json::array();
  for (std::size_t i = 0; i < page_fields.size(); ++i) {
    // The slider covers all snapshots, so it needs fields that all of them have.
    if (fields[i].reaches.size() != snapshots.size()) continue;
    json["fields"].push_back(field_data(shape_field(page_fields[i]), fields[i], printed_unit(field_units[i].symbol)));
  }
  return json;
}

}  // namespace vehd

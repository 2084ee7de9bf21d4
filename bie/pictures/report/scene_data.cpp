#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "bie/pictures/report/packed_coefficients.hpp"
#include "bie/pictures/report/page_data.hpp"
#include "bie/scene/dimensionless_groups.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/schema.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr std::size_t longest_value = 120;
constexpr double field_arrow = 1.4;
constexpr double flow_arrow = 0.7;

nlohmann::json list_of(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

nlohmann::json arrow(const char* kind, const char* label, const Vector3& from, const Vector3& to) {
  return {{"kind", kind}, {"label", label}, {"from", list_of(from)}, {"to", list_of(to)}};
}

nlohmann::json table_data(const TableDescription& table, const Scene& scene) {
  nlohmann::json rows = nlohmann::json::array();
  for (const KeyDescription& key : scene_keys()) {
    if (key.table != table.name || !applies(key, scene)) continue;
    const auto value = key.get(scene);
    if (!value) continue;
    std::string text = to_toml(key, *value);
    // A waveform may hold thousands of numbers; all are in the scene file.
    if (text.size() > longest_value) text = text.substr(0, text.rfind(' ', longest_value)) + " …";
    rows.push_back({{"key", key.name}, {"value", text}, {"symbol", key.symbol}, {"meaning", key.description}});
  }
  return {{"name", table.name}, {"meaning", table.description}, {"rows", rows}};
}

}  // namespace

nlohmann::json scene_data(const Scene& scene) {
  nlohmann::json json{{"text", effective_scene(scene)}, {"tables", nlohmann::json::array()}};
  for (const TableDescription& table : scene_tables()) {
    if (table.present(scene)) json["tables"].push_back(table_data(table, scene));
  }
  return json;
}

nlohmann::json groups_data(const Scene& scene) {
  nlohmann::json json = nlohmann::json::array();
  try {
    for (const DimensionlessGroup& group : dimensionless_groups(scene)) {
      json.push_back({{"name", group.name},
                      {"symbol", group.symbol},
                      {"value", rounded_for_page(group.value)},
                      {"si", si_text(scene, group)},
                      {"meaning", group.meaning}});
    }
  } catch (const InputError&) {
    // The groups are those of the initial shape, which only the missing file contains.
    return nlohmann::json::array();
  }
  return json;
}

nlohmann::json arrows_data(const Scene& scene) {
  nlohmann::json json = nlohmann::json::array();
  if (scene.electric) {
    const auto& e = scene.electric->field;
    const Vector3 direction = Vector3(e[0], e[1], e[2]).stableNormalized();
    if (!direction.isZero())
      json.push_back(arrow("field", "E", -0.5 * field_arrow * direction, 0.5 * field_arrow * direction));
  }
  const Model model = model_of(scene);
  if (!model.flow) return json;
  const Matrix3& gradient = model.flow->gradient;
  const double largest = gradient.colwise().norm().maxCoeff();
  bool is_first = true;
  for (Index axis = 0; largest > 0.0 && axis < gradient.cols(); ++axis) {
    const Vector3 velocity = gradient.col(axis) / largest;
    if (velocity.isZero(1e-3)) continue;
    for (const double side : {1.0, -1.0}) {
      const Vector3 from = side * Vector3::Unit(axis);
      json.push_back(arrow("flow", is_first ? "v" : "", from, from + side * flow_arrow * velocity));
      is_first = false;
    }
  }
  return json;
}

std::string headline_of(const Scene& scene) {
  const auto word = [&](const char* table) { return kind_of(scene, table); };
  std::string text = "A vesicle";
  if (scene.electric) text += " in an electric field";
  if (scene.flow) {
    std::string kind = word("flow");
    std::ranges::replace(kind, '_', ' ');
    text += fmt::format(" {} a flow ({})", scene.electric ? "and" : "in", kind);
  }
  if (scene.gravity) text += " under gravity";
  text += fmt::format("; start: {}; degree {}{}", word("shape"), scene.numerics.tolerance ? "up to " : "",
                      scene.numerics.order);
  if (scene.numerics.tolerance) text += fmt::format(", tolerance {:g}", *scene.numerics.tolerance);
  return text;
}

}  // namespace vehd

#include "fem_check/app/result.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vehd::fem_check {
namespace {

nlohmann::json json_of(const Norms& norms) { return {{"l2", norms.l2}, {"max", norms.max}}; }

nlohmann::json json_of(const FieldComparison& field) {
  return {{"l2", field.difference.l2},        {"max", field.difference.max},
          {"fem_error", field.fem_error()},   {"fem_levels_change", json_of(field.levels_change)},
          {"fem_tail", field.tail},           {"fem_truncation", json_of(field.truncation)},
          {"fem_solver", field.solver},       {"fem_time", field.time},
          {"bie_error", field.bie_error()},   {"bie_change", json_of(field.bie_change)},
          {"bie_tail", field.bie_tail},       {"bie_further", field.bie_further},
          {"verdict", name_of(field.verdict)}};
}

/// Fields of one level: the i-th level of a problem is entry i of those of its fields that every level has.
nlohmann::json level_fields(const CheckResult& result, const Level& level, std::size_t index, std::size_t n_levels) {
  nlohmann::json json = nlohmann::json::object();
  // Both flows have a velocity, and V_m is advanced in time as well.
  const RowGroup group = level.problem == shape_flow_problem ? RowGroup::from_shape
                         : level.problem == charging_problem ? RowGroup::in_time
                                                             : RowGroup::fields;
  for (const FieldComparison& field : result.fields) {
    const bool of_problem = level.surface.contains(field.name) && field.group == group;
    if (of_problem && field.of_levels.size() == n_levels) json[field.name] = json_of(field.of_levels[index]);
  }
  return json;
}

nlohmann::json levels_json(const CheckResult& result) {
  nlohmann::json json = nlohmann::json::array();
  for (std::size_t i = 0; i < result.levels.size(); ++i) {
    const Level& level = result.levels[i];
    const auto same = [&](const Level& other) { return other.problem == level.problem; };
    const auto begin = result.levels.begin(), here = begin + static_cast<std::ptrdiff_t>(i);
    const auto n_levels = static_cast<std::size_t>(std::count_if(begin, result.levels.end(), same));
    const auto index = static_cast<std::size_t>(std::count_if(begin, here, same));
    json.push_back({{"problem", level.problem},
                    {"degree", level.degree},
                    {"cells", level.n_cells},
                    {"dofs", level.n_unknowns},
                    {"seconds", level.seconds},
                    {"memory_bytes", level.peak_memory_bytes},
                    {"fields", level_fields(result, level, index, n_levels)}});
  }
  return json;
}

std::string label_of(const FieldComparison& field) {
  if (field.group == RowGroup::stored) return "stored " + field.label;
  if (field.group == RowGroup::in_time) return field.label + " in time";
  return field.group == RowGroup::from_shape ? field.label + " from shape" : field.label;
}

/// A row with its label in the table.
struct Row {
  std::string label;
  const FieldComparison* field;
};

std::vector<Row> rows_of(const CheckResult& result) {
  std::vector<Row> rows;
  const std::string prefix = result.name.empty() ? "" : result.name + ": ";
  for (const FieldComparison& field : result.fields) rows.push_back({prefix + label_of(field), &field});
  for (const CheckResult& vesicle : result.vesicles) {
    for (const Row& row : rows_of(vesicle)) rows.push_back(row);
  }
  return rows;
}

std::string text_of(const Row& row, std::size_t width) {
  const FieldComparison& field = *row.field;
  const std::string fem = field.of_levels.empty() ? "-" : fmt::format("{:.1e}", field.fem_error());
  return fmt::format("{:<{}} {:>9.1e} {:>9.1e}   {:>9} {:>6}   {:>9.1e}   {}\n", row.label, width, field.difference.l2,
                     field.difference.max, fem, field.order ? fmt::format("{:.1f}", *field.order) : "-",
                     field.bie_error(), name_of(field.verdict));
}

/// Below the table.
std::string further_lines(const CheckResult& result) {
  std::string text;
  if (result.in_time) {
    text +=
        fmt::format("V_m in time: from time {:g} in {} steps{}{}\n", result.in_time->begin, result.in_time->steps,
                    result.in_time->order ? fmt::format(", order {:.1f} in their size", *result.in_time->order) : "",
                    result.in_time->moves ? ", on the moving shape" : "");
  }
  if (result.divergence) {
    text += fmt::format(
        "{}surface divergence of v as the elements see it: {:.1e} of the strain rate (levels differ by {:.1e})\n",
        result.name.empty() ? "" : result.name + ": ", result.divergence->size.l2, result.divergence->levels_change.l2);
  }
  for (const CheckResult& vesicle : result.vesicles) text += further_lines(vesicle);
  return text;
}

/// What boundary integrals were solved with.
std::string degrees_of(const CheckResult& result) {
  if (result.vesicles.empty()) {
    return fmt::format("degree {}, their error from degree {}", result.order, result.high_order);
  }
  std::string orders, high_orders;
  for (const CheckResult& vesicle : result.vesicles) {
    orders += fmt::format("{}{}", orders.empty() ? "" : " and ", vesicle.order);
    high_orders += fmt::format("{}{}", high_orders.empty() ? "" : " and ", vesicle.high_order);
  }
  return fmt::format("degrees {}, their error from degrees {}", orders, high_orders);
}

}  // namespace

Verdict CheckResult::verdict() const {
  const std::vector<Row> rows = rows_of(*this);
  const auto has = [&](Verdict verdict) {
    return std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.field->verdict == verdict; });
  };
  if (has(Verdict::does_not)) return Verdict::does_not;
  return has(Verdict::undecided) || rows.empty() ? Verdict::undecided : Verdict::agree;
}

std::string CheckResult::rows_with(Verdict verdict) const {
  std::string text;
  for (const Row& row : rows_of(*this)) {
    if (row.field->verdict == verdict) text += (text.empty() ? "" : ", ") + row.label;
  }
  return text;
}

std::string table_of(const CheckResult& result) {
  const std::vector<Row> rows = rows_of(result);
  std::size_t width = 20;
  for (const Row& row : rows) width = std::max(width, row.label.size());
  std::string text = fmt::format(
      "{} at time {:g}: boundary integrals of {}, finite elements to R = {:.3g}\nrequired: errors below {:.3g} of each "
      "field\n",
      result.source, result.time, degrees_of(result), result.outer_radius, result.required);
  text += fmt::format("{:<{}} {:>9} {:>9}   {:>9} {:>6}   {:>9}   {}\n", "field", width, "diff. L2", "max", "FEM error",
                      "order", "BIE error", "verdict");
  for (const Row& row : rows) text += text_of(row, width);
  return text + further_lines(result);
}

namespace {

/// What goes with one vesicle.
nlohmann::json vesicle_json(const CheckResult& result) {
  nlohmann::json fields = nlohmann::json::object(), from_shape = fields, stored = fields, in_time = fields,
                 orders = fields;
  for (const FieldComparison& field : result.fields) {
    nlohmann::json& group = field.group == RowGroup::stored       ? stored
                            : field.group == RowGroup::from_shape ? from_shape
                            : field.group == RowGroup::in_time    ? in_time
                                                                  : fields;
    group[field.name] = json_of(field);
    const bool own_group = field.group == RowGroup::from_shape || field.group == RowGroup::in_time;
    if (field.order && own_group) group[field.name]["order_observed"] = *field.order;
    if (field.order && field.group == RowGroup::fields) orders[field.name] = *field.order;
  }
  nlohmann::json json{{"order", result.order},
                      {"high_order", result.high_order},
                      {"fields", fields},
                      {"from_shape", from_shape},
                      {"stored", stored},
                      {"order_observed", orders},
                      {"levels", levels_json(result)}};
  if (result.in_time) {
    in_time["begin"] = result.in_time->begin;
    in_time["steps"] = result.in_time->steps;
    in_time["moves"] = result.in_time->moves;
    if (result.in_time->order) in_time["order_in_time"] = *result.in_time->order;
    json["in_time"] = in_time;
  }
  if (result.divergence) {
    json["surface_divergence"] = json_of(result.divergence->size);
    json["surface_divergence"]["fem_error"] = result.divergence->levels_change.l2;
  }
  if (result.stored_velocity) json["stored_velocity"] = *result.stored_velocity;
  return json;
}

}  // namespace

nlohmann::json json_of(const CheckResult& result) {
  nlohmann::json json = result.vesicles.empty() ? vesicle_json(result) : nlohmann::json::object();
  for (const CheckResult& vesicle : result.vesicles) {
    nlohmann::json& of_vesicle = json["vesicles"].emplace_back(vesicle_json(vesicle));
    of_vesicle["name"] = vesicle.name;
    of_vesicle["verdict"] = name_of(vesicle.verdict());
  }
  json["source"] = result.source;
  json["time"] = result.time;
  json["required"] = result.required;
  json["verdict"] = name_of(result.verdict());
  json["truncation_radius"] = result.outer_radius;
  json["exterior_degree"] = usual_exterior_degree;
  json["exterior_degree_second"] = truncated_exterior_degree;
  json["seconds"] = result.seconds;
  return json;
}

}  // namespace vehd::fem_check

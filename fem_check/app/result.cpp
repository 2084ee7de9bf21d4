#include "fem_check/app/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace vehd::fem_check {
namespace {

nlohmann::json json_of(const Norms& norms) { return {{"l2", norms.l2}, {"max", norms.max}}; }

nlohmann::json json_of(const FieldComparison& field) {
  return {{"l2", field.difference.l2},
          {"max", field.difference.max},
          {"fem_error", field.fem_error()},
          {"fem_levels_change", json_of(field.levels_change)},
          {"fem_tail", field.tail},
          {"fem_truncation", json_of(field.truncation)},
          {"fem_solver", field.solver},
          {"fem_time", field.time},
          {"bie_error", field.bie_error()},
          {"bie_change", json_of(field.bie_change)},
          {"bie_tail", field.bie_tail},
          {"bie_further", field.bie_further},
          {"floor", field.floor},
          {"judged_by", name_of(field.reference)},
          {"verdict", name_of(field.verdict)},
          {"counts", field.counts()}};
}

/// Fields of one level; entry i of of_levels belongs to the i-th level of a problem if every level has the field.
nlohmann::json level_fields(const CheckResult& result, const Level& level, std::size_t index, std::size_t n_levels) {
  nlohmann::json json = nlohmann::json::object();
  // Needed since both flows have a velocity and V_m also occurs in time.
  const bool of_shape = level.problem == shape_flow_problem || level.problem == bending_problem;
  const RowGroup group = of_shape                            ? RowGroup::from_shape
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

/// Verdict with the error that leaves it undecided, and the marks that the legend explains.
std::string verdict_text(const FieldComparison& field, double required) {
  std::string text = name_of(field.verdict);
  if (field.verdict == Verdict::undecided) {
    const bool elements = !(field.fem_error() <= required), run = !(field.bie_error() <= required);
    text += fmt::format(": {} error", elements && run ? "either" : elements ? "FEM" : "run");
  }
  if (!field.counts()) text = "(" + text + ")";
  return field.reference == Reference::boundary_integrals ? text + " *" : text;
}

std::string text_of(const Row& row, std::size_t width, double required) {
  const FieldComparison& field = *row.field;
  const std::string fem = field.reference == Reference::elements ? fmt::format("{:.1e}", field.fem_error()) : "-";
  return fmt::format("{:<{}} {:>9.1e} {:>9.1e}   {:>9} {:>6}   {:>9.1e}   {}\n", row.label, width, field.difference.l2,
                     field.difference.max, fem, field.order ? fmt::format("{:.1f}", *field.order) : "-",
                     field.bie_error(), verdict_text(field, required));
}

/// Legend: meaning of columns and marks, and remarks that belong to no row.
std::string legend_of(const CheckResult& result, const std::vector<Row>& rows) {
  const auto any = [&](const auto& holds) {
    return std::ranges::any_of(rows, [&](const Row& row) { return holds(*row.field); });
  };
  std::string text = fmt::format(
      "  diff.: finite elements against boundary integrals, or against the number of the snapshot (stored), over the "
      "field\n"
      "  FEM error, run error: discretisation errors of the elements and of the degree of the run\n"
      "  agree: the difference is within both errors, each at most {0:.3g} of the field; disagree: it is larger;\n"
      "  undecided: it is within them, but the error that is named is larger than {0:.3g}\n",
      result.required);
  if (any([](const FieldComparison& field) { return field.reference == Reference::boundary_integrals; })) {
    text += "  *: compared with a new solution by boundary integrals, not with finite elements\n";
  }
  if (any([](const FieldComparison& field) { return !field.counts(); })) {
    text += "  (...): does not count, as the row of the work of this force is judged in its place\n";
  }
  const bool in_time = any([](const FieldComparison& field) { return field.group == RowGroup::in_time; });
  const bool electric = any([](const FieldComparison& field) { return field.name == "q"; });
  if (electric && !in_time) {
    text += "  V_m is given to both methods: C_m, G_m and the mean of V_m are judged by --from alone\n";
  }
  return text;
}

/// "verdict: the two methods agree", or the rows that disagree or are undecided.
std::string verdict_line(const CheckResult& result, const std::vector<Row>& rows) {
  const Verdict verdict = result.verdict();
  if (verdict == Verdict::agree) return "verdict: the two methods agree\n";
  const std::string which = fmt::format("in {} of {} rows: {}", result.rows_with(verdict).size(), rows.size(),
                                        fmt::join(result.rows_with(verdict), ", "));
  if (verdict == Verdict::disagree) return fmt::format("verdict: the two methods disagree {}\n", which);
  return fmt::format("verdict: undecided {}\n", which);
}

/// Lines below the table.
std::string further_lines(const CheckResult& result) {
  std::string text;
  if (result.in_time) {
    text +=
        fmt::format("V_m in time: from time {} in {} steps{}{}\n", result.in_time->begin_text, result.in_time->steps,
                    result.in_time->order ? fmt::format(", order {:.1f} in their size", *result.in_time->order) : "",
                    result.in_time->moves ? ", on the moving shape" : "");
  }
  if (result.divergence) {
    text += fmt::format(
        "{}surface divergence of the finite-element velocity: {:.1e} of the strain rate (change from the previous "
        "level: "
        "{:.1e})\n",
        result.name.empty() ? "" : result.name + ": ", result.divergence->size.l2, result.divergence->levels_change.l2);
  }
  for (const CheckResult& vesicle : result.vesicles) text += further_lines(vesicle);
  return text;
}

/// Degrees of the boundary integrals.
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
    return std::ranges::any_of(rows,
                               [&](const Row& row) { return row.field->counts() && row.field->verdict == verdict; });
  };
  if (has(Verdict::disagree)) return Verdict::disagree;
  return has(Verdict::undecided) || rows.empty() ? Verdict::undecided : Verdict::agree;
}

std::vector<std::string> CheckResult::rows_with(Verdict verdict) const {
  std::vector<std::string> labels;
  for (const Row& row : rows_of(*this)) {
    if (row.field->counts() && row.field->verdict == verdict) labels.push_back(row.label);
  }
  return labels;
}

std::string table_of(const CheckResult& result) {
  const std::vector<Row> rows = rows_of(result);
  std::size_t width = 20;
  for (const Row& row : rows) width = std::max(width, row.label.size());
  std::string text = fmt::format(
      "{} at time {}: boundary integrals of {}, finite elements to R = {:.3g}\nrequired: errors below {:.3g} of each "
      "field\n",
      result.source, result.time_text, degrees_of(result), result.outer_radius, result.required);
  text += fmt::format("{:<{}} {:>9} {:>9}   {:>9} {:>6}   {:>9}   {}\n", "field", width, "diff. L2", "max", "FEM error",
                      "order", "run error", "verdict");
  for (const Row& row : rows) text += text_of(row, width, result.required);
  return text + further_lines(result) + legend_of(result, rows) + verdict_line(result, rows);
}

namespace {

/// JSON of the result of one vesicle.
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

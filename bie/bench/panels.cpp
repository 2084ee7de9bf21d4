#include "bie/bench/panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/support/errors.hpp"

namespace vehd {

std::size_t BenchRecord::index(const std::string& column) const {
  if (const auto found = find(column)) return *found;
  throw InputError(fmt::format("{}: has no column {}", header_place(), column));
}

std::vector<std::string> BenchRecord::texts(const std::string& column, const std::string& key,
                                            const std::string& value) const {
  const std::size_t at = index(column);
  std::vector<std::string> result;
  for (std::size_t row = 0; row < n_rows(); ++row) {
    if (key.empty() || text(row, index(key)) == value) result.push_back(text(row, at));
  }
  return result;
}

std::vector<double> BenchRecord::numbers(const std::string& column, const std::string& key,
                                         const std::string& value) const {
  std::vector<double> result;
  for (const std::string& text : texts(column, key, value)) result.push_back(number_of_cell(text));
  return result;
}

std::vector<std::string> BenchRecord::different(const std::string& column) const {
  std::vector<std::string> result;
  for (const std::string& text : texts(column)) {
    if (std::ranges::find(result, text) == result.end()) result.push_back(text);
  }
  return result;
}

namespace {

/// Columns of a curve, and the column and the value that select its rows.
struct CurveColumns {
  std::string x, y, key{}, value{}, note{};
};

BenchCurve curve_of(const BenchRecord& record, const std::string& label, const CurveColumns& columns, int colour,
                    CurveKind kind = CurveKind::line) {
  BenchCurve curve{label, record.numbers(columns.x, columns.key, columns.value),
                   record.numbers(columns.y, columns.key, columns.value)};
  if (!columns.note.empty()) curve.notes = record.texts(columns.note, columns.key, columns.value);
  curve.colour = colour;
  curve.kind = kind;
  return curve;
}

std::vector<BenchPanel> space_panels(const BenchRecord& record) {
  BenchPanel seconds{"seconds", "relative error, maximum over the nodes"};
  // q and f_E have the same seconds, so notes at the upper curve are enough.
  seconds.curves = {curve_of(record, "q, Example 1", {"seconds", "error_q"}, 0),
                    curve_of(record, "f_E, Example 1", {"seconds", "error_force", "", "", "order"}, 1),
                    curve_of(record, "v, prolate", {"seconds_velocity", "error_velocity", "", "", "order"}, 2)};
  BenchPanel degree{"degree p", ""};
  degree.straight_x = true;
  degree.curves = {curve_of(record, "q, Example 1", {"order", "error_q"}, 0),
                   curve_of(record, "f_E, Example 1", {"order", "error_force"}, 1),
                   curve_of(record, "v, prolate", {"order", "error_velocity"}, 2)};
  return {seconds, degree};
}

/// Order of an integrator from its name, "order 4"; 0 for a tolerance or a reference.
int order_of_integrator(const std::string& name) {
  const std::string start = "order ";
  return name.starts_with(start) ? std::stoi(name.substr(start.size())) : 0;
}

bool has_points(const BenchCurve& curve) {
  return std::ranges::any_of(curve.y, [](double y) { return y > 0.0; });
}

std::vector<BenchPanel> time_panels(const BenchRecord& record) {
  // Further tables of this bench have no curves.
  if (!record.find("steps")) return {};
  // Errors of the steps only, which files of earlier versions lack.
  const bool apart = record.find("error_in_time").has_value();
  const std::string error = apart ? "error_in_time" : "error";
  BenchPanel seconds{"seconds", "largest relative error"};
  BenchPanel steps{"steps", apart ? "error of the steps alone" : ""};
  int colour = 0;
  for (const std::string& integrator : record.different("integrator")) {
    BenchCurve in_seconds =
        curve_of(record, integrator, {"seconds", "error", "integrator", integrator, "setting"}, colour);
    BenchCurve in_steps = curve_of(record, integrator, {"steps", error, "integrator", integrator}, colour);
    ++colour;
    if (has_points(in_seconds)) seconds.curves.push_back(std::move(in_seconds));
    if (!has_points(in_steps)) continue;
    const int order = order_of_integrator(integrator);
    // The numbers of steps span few powers of ten, so they give the ticks.
    if (order > 0 && steps.x_ticks.empty()) steps.x_ticks = in_steps.x;
    if (order > 0 && (apart || order <= 2)) {
      steps.slopes.push_back(slope_beside(in_steps, -order, fmt::format("N^{{\u2212{}}}", order), 0.45));
    }
    steps.curves.push_back(std::move(in_steps));
  }
  return {seconds, steps};
}

std::string with_spaces(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::vector<BenchPanel> parts_panels(const BenchRecord& record) {
  const std::vector<double> orders = record.numbers("order");
  BenchPanel seconds{"degree p", "seconds of a step"}, memory{"degree p", "memory, bytes"};
  seconds.x_ticks = memory.x_ticks = orders;
  int colour = 0;
  const std::string start = "seconds_";
  for (const std::string& column : record.names()) {
    if (!column.starts_with(start) || !record.find(column + "_min")) continue;
    const std::string part = column.substr(start.size());
    // The whole step lies above all its parts in seconds, and hardly above the largest in memory.
    const CurveKind kind = part == "step" ? CurveKind::wide : CurveKind::line;
    seconds.curves.push_back(curve_of(record, with_spaces(part), {"order", column}, colour, kind));
    BenchCurve bytes = curve_of(record, with_spaces(part), {"order", "bytes_" + part}, colour, kind);
    ++colour;
    if (has_points(bytes)) memory.curves.push_back(std::move(bytes));
  }
  if (!seconds.curves.empty()) {
    seconds.slopes = {slope_beside(seconds.curves.front(), 3.0, "p^3", 2.2),
                      slope_beside(seconds.curves.front(), 5.0, "p^5", 6.0, 2)};
  }
  if (!memory.curves.empty()) memory.slopes = {slope_beside(memory.curves.front(), 4.0, "p^4", 2.2)};
  return {seconds, memory};
}

std::vector<BenchPanel> threads_panels(const BenchRecord& record) {
  const std::vector<std::string> counts = record.different("threads");
  BenchPanel panel{"", "seconds of a step"};
  if (counts.size() > 1)
    panel.x_label = fmt::format("×: how much faster {} are than {}", counts.back(), counts.front());
  for (const std::string& threads : counts) {
    panel.bars.bars.push_back(threads == "1" ? "1 thread" : threads + " threads");
  }
  for (const std::string& part : record.different("part")) {
    panel.bars.groups.push_back(part);
    panel.bars.values.push_back(record.numbers("seconds", "part", part));
    const double speed_up = record.numbers("speed_up", "part", part).back();
    panel.bars.notes.push_back(panel.bars.bars.size() > 1 ? fmt::format("× {:.2f}", speed_up) : "");
  }
  return {panel};
}

std::vector<BenchPanel> symmetry_panels(const BenchRecord& record) {
  BenchPanel panel{"degree p", "seconds of a step"};
  panel.x_ticks = record.numbers("order");
  panel.curves = {curve_of(record, "full solver", {"order", "seconds_full"}, 0),
                  curve_of(record, "with symmetry", {"order", "seconds"}, 1)};
  return {panel};
}

/// Errors of two fields by each method.
struct MethodFields {
  std::string first, first_label, second, second_label;
};

std::vector<BenchPanel> panels_of_methods(const BenchRecord& record, const MethodFields& fields) {
  BenchPanel seconds{"seconds of one core", "relative error, L2 over the membrane"}, unknowns{"unknowns", ""};
  int colour = 0;
  for (const std::string& method : record.different("method")) {
    const std::string label = record.texts("label", "method", method).front();
    for (const bool is_second : {false, true}) {
      const std::string error = "error_" + (is_second ? fields.second : fields.first);
      const std::string name = label + ": " + (is_second ? fields.second_label : fields.first_label);
      const CurveKind kind = is_second ? CurveKind::dashed : CurveKind::line;
      seconds.curves.push_back(curve_of(record, name, {"seconds", error, "method", method}, colour, kind));
      unknowns.curves.push_back(curve_of(record, name, {"unknowns", error, "method", method}, colour, kind));
      if (method == "fem_mesh" && is_second) {
        unknowns.slopes.push_back(slope_beside(unknowns.curves.back(), -0.75, "N^{\u22120.75}", 3.0));
      }
    }
    ++colour;
  }
  return {seconds, unknowns};
}

std::vector<BenchPanel> methods_panels(const BenchRecord& record) {
  return panels_of_methods(record, {"q", "q", "force", "f_E"});
}

std::vector<BenchPanel> from_shape_panels(const BenchRecord& record) {
  return panels_of_methods(record, {"velocity", "v", "tension", "λ"});
}

struct Maker {
  const char* bench;
  std::vector<BenchPanel> (*panels)(const BenchRecord& record);
};
constexpr std::array makers = {Maker{"space", space_panels},
                               Maker{"time", time_panels},
                               Maker{"parts", parts_panels},
                               Maker{"threads", threads_panels},
                               Maker{"symmetry", symmetry_panels},
                               Maker{"methods", methods_panels},
                               Maker{"methods_from_shape", from_shape_panels}};

}  // namespace

std::vector<BenchPanel> panels_of(const std::string& bench, const BenchRecord& record) {
  const std::string kind = bench.starts_with("time_") ? "time" : bench.starts_with("threads_") ? "threads" : bench;
  const auto maker = std::ranges::find_if(makers, [&](const Maker& candidate) { return kind == candidate.bench; });
  return maker == makers.end() ? std::vector<BenchPanel>{} : maker->panels(record);
}

}  // namespace vehd

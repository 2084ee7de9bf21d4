#include "bie/pictures/report/report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "bie/files/versions.hpp"
#include "bie/pictures/colours.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/pictures/report/page_data.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/progress.hpp"

namespace vehd {
namespace {

std::string name_of(const RunPaths& paths) {
  const std::filesystem::path directory = std::filesystem::absolute(paths.directory).lexically_normal();
  return (directory.has_filename() ? directory : directory.parent_path()).filename().string();
}

std::string with_letter_as(const std::string& text, char letter, std::string_view other) {
  std::string result;
  for (const char of_text : text) of_text == letter ? result += other : result += of_text;
  return result;
}

/// Escapes text between tags.
std::string html_text(const std::string& text) {
  return with_letter_as(with_letter_as(text, '&', "&amp;"), '<', "&lt;");
}

/// Escapes JSON within a script element, which the first "</" would end.
std::string json_within_page(const nlohmann::json& json) {
  return with_letter_as(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), '<', "\\u003c");
}

/// The page with its placeholders replaced; inserted text is not searched again.
std::string filled(std::string_view page, const std::vector<std::pair<std::string_view, std::string>>& places) {
  std::string result;
  std::size_t position = 0;
  while (position < page.size()) {
    const std::size_t start = page.find("{{", position);
    result += page.substr(position, start - position);
    if (start == std::string_view::npos) break;
    const std::size_t end = page.find("}}", start);
    const std::string_view name = page.substr(start + 2, end - start - 2);
    for (const auto& [place, text] : places) {
      if (place == name) result += text;
    }
    position = end + 2;
  }
  return result;
}

nlohmann::json palette_of(const ColourMap& colours) {
  constexpr int n_colours = 33;
  nlohmann::json palette = nlohmann::json::array();
  for (int i = 0; i < n_colours; ++i) {
    const Colour colour = colours.at(i / (n_colours - 1.0));
    palette.push_back({std::lround(255 * colour[0]), std::lround(255 * colour[1]), std::lround(255 * colour[2])});
  }
  return palette;
}

/// The time reached, with its unit as printed.
std::string reached_of(const HistoryTable& history) {
  const std::string number = fmt::format("{:.6g}", history.column("time").back()), unit = history.unit("time");
  return unit.empty() ? number : number + " " + printed_unit(unit);
}

nlohmann::json facts_of(const nlohmann::json& summary, const HistoryTable& history, const ReportSize& size) {
  nlohmann::json facts = nlohmann::json::array();
  const auto add = [&](const char* name, const std::string& value) { facts.push_back({name, value}); };
  if (!history.column("time").empty()) add("time reached", reached_of(history));
  add("steps", std::to_string(history.n_steps()));
  if (summary.is_object()) {
    const auto number = [&](const char* key) {
      return summary.contains(key) && summary[key].is_number() ? summary[key].get<double>() : std::nan("");
    };
    add("rejected steps", fmt::format("{:.0f}", number("rejected_steps")));
    add("computing time", duration_text(number("seconds")));
    add("memory", fmt::format("{:.0f} MB", number("peak_memory_bytes") / 1e6));
    add("highest degree", fmt::format("{:.0f}", number("order_max")));
    if (const std::string symmetry = summary.value("symmetry", "none"); symmetry != "none") {
      add("symmetry, imposed by the start", symmetry);
    }
    if (const auto poration = summary.find("poration"); poration != summary.end()) {
      add("criterion of poration", poration->value("text", std::string()));
    }
  }
  add("shapes in this page",
      size.snapshots == size.all ? std::to_string(size.all) : fmt::format("{} of {}", size.snapshots, size.all));
  return facts;
}

}  // namespace

ReportSize write_report(const ReportTask& task) {
  require_run(task.paths);
  ReportSize size;
  const RunReader run = read_snapshots(task.paths.snapshots(), size.notes);
  run.require_one_vesicle("vehd report");
  const Scene scene = read_scene_of(run);
  const HistoryTable history = read_table(task.paths.history(), size.notes);
  const nlohmann::json summary = read_summary(task.paths.summary(), size.notes);
  const std::vector<std::size_t> snapshots = snapshots_for_page(run, task.most_snapshots);
  size.snapshots = snapshots.size();
  size.all = run.times().size();

  nlohmann::json data{{"headline", headline_of(scene)},
                      {"verdict", verdict_data(history, scene, summary)},
                      {"facts", facts_of(summary, history, size)},
                      {"scene", scene_data(scene)},
                      {"groups", groups_data(scene)},
                      {"arrows", arrows_data(scene)},
                      {"history", history_data(history, scene)},
                      {"surface", surface_data(run, snapshots, history.units(scene.units), model_of(scene).wall)},
                      {"footer", fmt::format("Made by vehd {} from {}.", program_version(), run.name())}};
  data["palettes"] = {{"diverging", palette_of(ColourMap::diverging())},
                      {"sequential", palette_of(ColourMap::sequential())}};
  const PageFiles files = page_files();
  const std::string page = filled(files.page, {{"title", html_text(name_of(task.paths))},
                                               {"style", std::string(files.style)},
                                               {"script", std::string(files.script)},
                                               {"data", json_within_page(data)}});
  if (!task.output.parent_path().empty()) make_directory(task.output.parent_path());
  replace_file(task.output, page);
  size.bytes = page.size();
  return size;
}

}  // namespace vehd

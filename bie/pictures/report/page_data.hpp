#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/physics/wall.hpp"
#include "bie/runs/history.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/scene.hpp"

/// Data for the page of a report.
namespace vehd {

/// The verdict on a run for a page: "text", "state" (good, doubtful, stopped, unfinished), "limits", the worst value of
/// each judged number, and "warnings", texts about the physics.
/// @param summary  of the run; not an object if there is none because the run is under way or was killed
nlohmann::json verdict_data(const HistoryTable& history, const Scene& scene, const nlohmann::json& summary);

/// Indices of snapshots for a page, evenly spread, the first and the last included.
/// @param most  number of them, at least 2; fewer are taken if the page would exceed 8 MB
/// @throws InputError if the run cannot be read
std::vector<std::size_t> snapshots_for_page(const RunReader& run, std::size_t most);

/// Shapes and fields at these snapshots: "times", "degrees", "position", "fields" (those of V_m, q and tension that the
/// run has), "radius" of a ball that contains all shapes, "extents" along the axes. Positions are relative to their
/// mean over the parameter sphere. Beside a wall also "wall": its "normal" and the "heights" of the origin above it.
/// @param units  units of the numbers
/// @throws InputError if the run cannot be read
nlohmann::json surface_data(const RunReader& run, const std::vector<std::size_t>& snapshots, const OutputUnits& units,
                            const std::optional<Wall>& wall);

/// Plots of a page: "panels" of up to four curves each, as the effects of the scene and the columns of the history
/// allow. A long history is thinned out such that no peak is lost; a history of one row has no panels.
nlohmann::json history_data(const HistoryTable& history, const Scene& scene);

/// The effective scene for a page: its "text" and the "tables" of its keys with their meaning.
nlohmann::json scene_data(const Scene& scene);

/// The dimensionless groups of the scene; none if its shape file is missing.
nlohmann::json groups_data(const Scene& scene);

/// Arrows of the field and of a linear flow around the axes, which have length 1.
nlohmann::json arrows_data(const Scene& scene);

/// The scene in one line: shape, effects, degree.
std::string headline_of(const Scene& scene);

/// Sources of the page of a report, bie/pictures/report/page, embedded in the program by the build.
struct PageFiles {
  std::string_view page;    ///< HTML with placeholders {{title}}, {{style}}, {{script}} and {{data}}
  std::string_view style;   ///< all CSS
  std::string_view script;  ///< all JavaScript
};

/// Defined by a file that bie/cmake/report_page.cmake writes.
PageFiles page_files();

}  // namespace vehd

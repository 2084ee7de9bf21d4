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

/// Data of the page of a report.
namespace vehd {

/// The verdict on a run for a page: "text", "state" (good, doubtful, stopped, unfinished) and "limits", each number
/// that is judged with its worst value, and "warnings", texts about the physics.
/// @param summary  of the run; not an object where it has none, being under way or killed
nlohmann::json verdict_data(const HistoryTable& history, const Scene& scene, const nlohmann::json& summary);

/// Snapshots for a page, evenly spread with the first and the last.
/// @param most  of them, at least 2; fewer are taken where the page would grow beyond 8 MB
/// @throws InputError if the run cannot be read
std::vector<std::size_t> snapshots_for_page(const RunReader& run, std::size_t most);

/// Shapes and fields at these snapshots: "times", "degrees", "position", "fields" (V_m, q, tension, those that the run
/// has), "radius" of a ball that holds all shapes, "extents" along the axes. The position is relative to its mean over
/// the parameter sphere. Beside a wall "wall": its "normal" and the "heights" of the origin above it.
/// @param units  that the numbers are in
/// @throws InputError if the run cannot be read
nlohmann::json surface_data(const RunReader& run, const std::vector<std::size_t>& snapshots, const OutputUnits& units,
                            const std::optional<Wall>& wall);

/// Plots of a page: "panels" of up to four curves each, those that the effects of the scene and the columns of the
/// history allow. A long history is thinned out so that no peak is lost; of one row there are no panels.
nlohmann::json history_data(const HistoryTable& history, const Scene& scene);

/// The effective scene for a page: its "text" and the "tables" of its keys with their meaning.
nlohmann::json scene_data(const Scene& scene);

/// The dimensionless groups of the scene; none where its shape file is gone.
nlohmann::json groups_data(const Scene& scene);

/// Arrows of the field and of a linear flow around the axes, which have length 1.
nlohmann::json arrows_data(const Scene& scene);

/// The scene in one line: shape, effects, degree.
std::string headline_of(const Scene& scene);

/// The sources of a report's page, bie/pictures/report/page, as the build has put them into the program.
struct PageFiles {
  std::string_view page;    ///< HTML with places {{title}}, {{style}}, {{script}} and {{data}}
  std::string_view style;   ///< all CSS
  std::string_view script;  ///< all JavaScript
};

/// Defined by a file that bie/cmake/report_page.cmake writes.
PageFiles page_files();

}  // namespace vehd

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/files/run_reader.hpp"
#include "bie/pictures/colour_bar.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/pictures/shape_times.hpp"
#include "bie/pictures/shapes_key.hpp"
#include "bie/pictures/shapes_layout.hpp"
#include "bie/pictures/view.hpp"
#include "bie/runs/given_times.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {
namespace {

constexpr int picture_grid_order = 95;
/// Factor from the size of a shape to that of its cell.
constexpr double cell_margin = 1.03;
constexpr double time_size = 8.5;
constexpr const char* cut_colour = "#202020";
constexpr const char* wall_colour = "#606060";

/// Content of a picture before its parts have positions.
struct ShapesPicture {
  std::vector<Shape> shapes;
  std::array<double, 2> room{};  ///< least half extents of every shape
  double label_room = 0.0;       ///< least width of the text below it
  std::vector<std::string> times;
  Matrix3 view;
  ShownUnit length;
  std::optional<ColourBar> bar;
  ColourMap colours = ColourMap::sequential();
};

std::vector<std::string> time_texts(std::vector<double> times, const OutputUnits& units) {
  const ShownUnit unit = shown_unit(units, "time");
  for (double& time : times) time *= unit.factor;
  std::vector<std::string> texts;
  for (const std::string& text : distinct_texts(times)) {
    texts.push_back(fmt::format("t = {}{}{}", text, unit.unit.empty() ? "" : " ", unit.unit));
  }
  return texts;
}

/// @param range  of the field, in units of the scene
void colour_shapes(ShapesPicture& picture, const ShapeField& field, const ColourRange& range, const OutputUnits& units,
                   const Scene& scene) {
  if (field.values == ShapeField::Values::none) {
    // The middle of the diverging colours: white.
    picture.colours = ColourMap::diverging();
    for (Shape& shape : picture.shapes) shape.mesh.shade = Vector::Constant(shape.values.size(), 0.5);
    return;
  }
  const ShownUnit unit = shown_unit(units, field.dimension);
  ColourRange shown = range;
  shown.lower *= unit.factor;
  shown.upper *= unit.factor;
  picture.bar = colour_bar(shown, field_text(field, scene), unit.unit);
  picture.colours = range.both_signs ? ColourMap::diverging() : ColourMap::sequential();
  for (Shape& shape : picture.shapes) {
    shape.mesh.shade = (shape.values.array() - range.lower) / (range.upper - range.lower);
  }
}

ColourRange range_of(const std::vector<Shape>& shapes, const ShapeField& field) {
  std::vector<FieldReach> reaches;
  for (const Shape& shape : shapes) reaches.push_back(reach_of(shape.values, shape.weights));
  return robust_range(reaches, field.sign_matters);
}

/// Vector from the middle of a shape to a wall; none unless the wall is seen edge on and close enough to be shown.
std::optional<Eigen::Vector2d> foot_on_wall(const Scene& scene, const Shape& shape, const Matrix3& view) {
  constexpr double edge_on = 0.05, farthest = 2.0;
  if (!scene.wall) return std::nullopt;
  const Vector3 normal = vector_of(scene.wall->normal).normalized(), seen = view * normal;
  const Eigen::Vector2d foot = normal.dot(vector_of(scene.wall->point) - shape.centre) * seen.head<2>();
  if (std::abs(seen.z()) > edge_on || foot.norm() > farthest * projected_extent(shape.mesh, view).norm()) {
    return std::nullopt;
  }
  return foot;
}

/// Half width and half height of a shape about its middle, with the wall of foot_on_wall and a margin.
Eigen::Vector2d extent_of(const Scene& scene, const Shape& shape, const Matrix3& view) {
  Eigen::Vector2d extent = projected_extent(shape.mesh, view);
  if (const auto foot = foot_on_wall(scene, shape, view)) extent = extent.cwiseMax(foot->cwiseAbs());
  return cell_margin * extent;
}

ShapesContent content_of(const ShapesPicture& picture, const Scene& scene, const std::vector<KeyItem>& items,
                         double page_width) {
  ShapesContent content;
  content.label_width = picture.label_room;
  for (const Shape& shape : picture.shapes) {
    const Eigen::Vector2d extent = extent_of(scene, shape, picture.view);
    content.half_extents.push_back({std::max(extent.x(), picture.room[0]), std::max(extent.y(), picture.room[1])});
  }
  for (const std::string& text : picture.times) {
    content.label_width = std::max(content.label_width, time_size * text_width(text));
  }
  for (const KeyItem item : items) content.key_heights.push_back(key_height(item));
  content.key_width = key_width;
  content.bar_width = picture.bar ? width_of(*picture.bar) : 0.0;
  content.page_width = page_width;
  return content;
}

/// Draws the edge of a cut membrane.
void add_cut(Page& page, const Shape& shape, const Matrix3& view, const Box& cell, double scale) {
  const double x = 0.5 * (cell.left + cell.right), y = 0.5 * (cell.bottom + cell.top);
  const Matrix cut = scale * cut_lines(shape.mesh, view);
  for (Index i = 0; i < cut.rows(); ++i) {
    page.lines.push_back({{{x + cut(i, 0), y + cut(i, 1)}, {x + cut(i, 2), y + cut(i, 3)}}, 1.0, cut_colour, false});
  }
}

/// Draws a wall as the line through its foot that crosses the cell.
void add_wall(Page& page, const Eigen::Vector2d& foot, const Box& cell, double scale) {
  const Eigen::Vector2d middle(0.5 * (cell.left + cell.right), 0.5 * (cell.bottom + cell.top));
  const Eigen::Vector2d along = Eigen::Vector2d(-foot.y(), foot.x()).normalized();
  const Eigen::Vector2d half_cell(0.5 * cell.width(), middle.y() - cell.bottom);
  const double reach = half_cell.cwiseQuotient(along.cwiseAbs().cwiseMax(1e-9)).minCoeff();
  const Eigen::Vector2d at = middle + scale * foot, from = at - reach * along, to = at + reach * along;
  page.lines.push_back({{{from.x(), from.y()}, {to.x(), to.y()}}, 1.4, wall_colour, false});
}

Page page_of(const ShapesPicture& picture, const Scene& scene, const ShapesStyle& style) {
  const std::vector<KeyItem> items = key_items(scene);
  const ShapesLayout layout = layout_of(content_of(picture, scene, items, style.width));
  Page page{layout.width, layout.height};
  const int n_shapes = static_cast<int>(picture.shapes.size());
  page.images.resize(picture.shapes.size());
  const auto draw = [&](int i) {
    const Box& cell = layout.cells[i];
    RenderTask task{picture.view, layout.scale * page_pixels, 0, 0, style.section};
    task.width = std::max(1, static_cast<int>(std::lround(cell.width() * page_pixels)));
    task.height = std::max(1, static_cast<int>(std::lround(cell.height() * page_pixels)));
    page.images[i] = {render(picture.shapes[i].mesh, picture.colours, task), cell};
  };
  Exceptions exceptions(n_shapes);
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < n_shapes; ++i) exceptions.keep(i, [&] { draw(i); });
  exceptions.rethrow_first();
  for (std::size_t i = 0; i < picture.shapes.size(); ++i) {
    if (style.section) add_cut(page, picture.shapes[i], picture.view, layout.cells[i], layout.scale);
    if (const auto foot = foot_on_wall(scene, picture.shapes[i], picture.view)) {
      add_wall(page, *foot, layout.cells[i], layout.scale);
    }
    page.texts.push_back({picture.times[i], layout.labels[i], time_size, TextAnchor::centre, "#000000"});
  }
  const KeyTask key{scene, picture.view, layout.scale, picture.length};
  for (std::size_t i = 0; i < items.size(); ++i) draw_key_item(page, items[i], layout.key[i], key);
  if (picture.bar) draw_colour_bar(page, *picture.bar, picture.colours, layout.bar);
  return page;
}

Matrix3 view_of(const ShapesStyle& style, const Scene& scene, const Shape& first) {
  return style.view.empty() ? default_view(scene, first.gyration) : parse_view(style.view);
}

const ShapeField& field_of(const ShapesStyle& style, const RunSnapshot& first) {
  return style.field.empty() ? default_field(first) : shape_field(style.field);
}

std::vector<SnapshotChoice> without_repeats(const std::vector<SnapshotChoice>& all) {
  std::vector<SnapshotChoice> shapes;
  for (const SnapshotChoice& choice : all) {
    const auto same = std::ranges::find(shapes, choice.snapshot, &SnapshotChoice::snapshot);
    if (same == shapes.end()) {
      shapes.push_back(choice);
    } else if (!choice.note.empty()) {
      same->note += (same->note.empty() ? "" : "\n") + choice.note;
    }
  }
  return shapes;
}

}  // namespace

std::vector<SnapshotChoice> shapes_to_plot(const PlotTask& task, const RunReader& run) {
  if (task.times.size() > most_shapes) {
    throw InputError(
        fmt::format("{} times are too many for one picture; accepted: at most {}", task.times.size(), most_shapes));
  }
  std::vector<SnapshotChoice> all;
  const std::filesystem::path file = task.paths.snapshots();
  const GivenTimes given(run, file);
  for (const std::string& time : task.times) {
    all.push_back(choose_snapshot(run, file, given.number_of(time), given.shown()));
  }
  if (task.times.empty()) {
    for (const std::size_t snapshot : snapshots_by_change(run, most_shapes)) all.push_back({snapshot, ""});
  }
  return without_repeats(all);
}

PlotResult plot_shapes(const PlotTask& task, const PictureFile& file) {
  require_run(task.paths);
  PlotResult result{{file.path}, {}};
  const RunReader run = read_snapshots(task.paths.snapshots(), result.notes);
  const Scene scene = read_scene_of(run);
  const OutputUnits units = units_of_run(task.paths, scene.units, result.notes);
  const std::vector<SnapshotChoice> choices = shapes_to_plot(task, run);
  const ShapeField& field = field_of(task.style, run.snapshot(choices.front().snapshot));
  ShapesPicture picture;
  std::vector<double> times;
  for (const SnapshotChoice& choice : choices) {
    const RunSnapshot snapshot = run.snapshot(choice.snapshot);
    require_field(snapshot, field);
    picture.shapes.push_back(shape_of(read_shape(snapshot, field), field, picture_grid_order));
    times.push_back(picture.shapes.back().time);
    if (!choice.note.empty()) result.notes.push_back(choice.note);
  }
  picture.view = view_of(task.style, scene, picture.shapes.front());
  picture.times = time_texts(times, units);
  const OutputUnit unit = units.of("time");
  for (const double time : times) result.times.push_back(time * unit.factor);
  if (unit.is_si()) result.time_unit = unit.symbol;
  picture.length = shown_unit(units, "length");
  colour_shapes(picture, field, range_of(picture.shapes, field), units, scene);
  draw_page(page_of(picture, scene, task.style), file);
  return result;
}

FrameDrawer shape_frames(const PlotTask& task, const RunReader& run, const std::vector<std::size_t>& snapshots) {
  const Scene scene = read_scene_of(run);
  ReadingNotes notes;
  const OutputUnits units = units_of_run(task.paths, scene.units, notes);
  const ShapeField& field = field_of(task.style, run.snapshot(snapshots.front()));
  // A coarse grid is enough for the quantities that all frames share.
  constexpr int coarse_order = 24;
  std::vector<ShapeCoefficients> read;
  std::vector<Shape> shapes;
  std::vector<double> times;
  for (const std::size_t number : snapshots) {
    const RunSnapshot snapshot = run.snapshot(number);
    require_field(snapshot, field);
    read.push_back(read_shape(snapshot, field));
    shapes.push_back(shape_of(read.back(), field, coarse_order));
    times.push_back(shapes.back().time);
  }
  const std::vector<std::string> texts = time_texts(times, units);
  ShapesPicture frame;
  frame.view = view_of(task.style, scene, shapes.front());
  frame.length = shown_unit(units, "length");
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Eigen::Vector2d extent = cell_margin * extent_of(scene, shapes[i], frame.view);
    frame.room = {std::max(frame.room[0], extent.x()), std::max(frame.room[1], extent.y())};
    frame.label_room = std::max(frame.label_room, time_size * text_width(texts[i]));
  }
  return [=, range = range_of(shapes, field), style = task.style](std::size_t i, const std::filesystem::path& picture) {
    ShapesPicture drawn = frame;
    drawn.shapes.push_back(shape_of(read[i], field, picture_grid_order));
    drawn.times = {texts[i]};
    colour_shapes(drawn, field, range, units, scene);
    draw_page(page_of(drawn, scene, style), {picture, PictureFormat::png});
  };
}

void require_run(const RunPaths& paths) {
  if (!std::filesystem::exists(paths.snapshots())) {
    if (std::filesystem::exists(paths.directory / "runs")) {
      throw InputError(
          fmt::format("{}: holds runs, but no table of a sweep yet (no sweep.json)", paths.directory.string()));
    }
    throw InputError(fmt::format("{}: holds no run (no run.h5)", paths.directory.string()));
  }
}

PlotResult plot_run(const PlotTask& task) {
  require_run(task.paths);
  make_directory(task.output);
  const auto file = [&](const char* stem) {
    return PictureFile{task.output / fmt::format("{}.{}", stem, name_of(task.format)), task.format};
  };
  PlotResult result = plot_shapes(task, file("shapes"));
  if (plot_history(task, file("history"))) result.pictures.push_back(file("history").path);
  return result;
}

}  // namespace vehd

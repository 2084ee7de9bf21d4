#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "bie/files/run_reader.hpp"
#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/pictures/renderer.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/surface_mesh.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/temporary.hpp"

namespace vehd {
namespace {

constexpr std::size_t most_shapes = 6;
constexpr int picture_grid_order = 95;
constexpr int widest_picture = 2400;
constexpr int label_height = 56;
constexpr int bar_room = 190;
constexpr int bar_width = 28;
constexpr double cell_margin = 1.08;
constexpr double cell_margin_up = 1.03;

/// From the front, slightly right and above: the x-z plane of flow and field stays recognisable.
Camera camera_for(double radius) { return {14.0, 16.0, 5.0 * radius}; }

struct Field {
  std::string name;   ///< in run.h5; empty if there is none to show
  std::string label;  ///< for gnuplot
};

struct ColourRange {
  double lower = 0.0, upper = 1.0;
  bool both_signs = false;
};

struct Shape {
  double time = 0.0;
  RenderMesh mesh;
  Vector values;
};

Field field_to_show(const RunReader& run, std::size_t snapshot) {
  if (run.has_field(snapshot, "Vm")) return {"Vm", "V_m"};
  if (run.has_field(snapshot, "tension")) return {"tension", "tension λ"};
  return {};
}

Matrix normals_of(const SphereDerivatives& position) {
  Matrix normals(position.d1.rows() + 2, 3);
  for (Index i = 0; i < position.d1.rows(); ++i) {
    normals.row(i) = Vector3(position.d1.row(i)).cross(Vector3(position.d2.row(i))).normalized();
  }
  return normals;
}

Shape shape_of(const RunReader& run, std::size_t snapshot, const Field& field) {
  Shape shape;
  shape.time = run.times()[snapshot];
  const Matrix position = run.coefficients(snapshot, "x");
  const int order = order_of(position.rows());
  const SphereTransform transform(order, make_grid(std::max(picture_grid_order, order)));
  const SphereGrid& grid = transform.grid();
  const SphereDerivatives derivatives = transform.synthesize_gradient(position);
  shape.mesh.points = with_poles(derivatives.value, position);
  shape.mesh.points.rowwise() -= shape.mesh.points.colwise().mean();
  shape.mesh.normals = normals_of(derivatives);
  const Index n = grid.n_points();
  shape.mesh.normals.row(n) = shape.mesh.normals.topRows(grid.n_phi).colwise().mean().normalized();
  shape.mesh.normals.row(n + 1) =
      shape.mesh.normals.middleRows(n - grid.n_phi, grid.n_phi).colwise().mean().normalized();
  shape.mesh.triangles = closed_triangles(grid);
  if (field.name.empty()) {
    shape.values = Vector::Zero(n + 2);
  } else {
    const Matrix coefficients = run.coefficients(snapshot, field.name);
    shape.values = with_poles(transform.synthesize(coefficients), coefficients).col(0);
  }
  return shape;
}

/// Rounded away from zero to two digits, for an end of the colour bar.
double rounded_up(double value) {
  if (value == 0.0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 1.0);
  return std::copysign(std::ceil(std::abs(value) / unit - 1e-9) * unit, value);
}

/// Least and largest value of a field, over one shape or many.
struct Extremes {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;

  void add(const Shape& shape) {
    lower = std::min(lower, shape.values.minCoeff());
    upper = std::max(upper, shape.values.maxCoeff());
  }
};

ColourRange range_of(const Extremes& extremes, const Field& field) {
  const auto& [lower, upper] = extremes;
  ColourRange range;
  range.both_signs = field.name == "Vm";
  if (range.both_signs) {
    range.upper = rounded_up(std::max(std::abs(lower), std::abs(upper)));
    range.lower = -range.upper;
  } else {
    range.lower = lower;
    range.upper = upper;
  }
  // A constant field, also one that is constant up to rounding, has no scale of its own.
  const double magnitude = std::max(std::abs(range.lower), std::abs(range.upper));
  if (range.upper - range.lower <= 1e-9 * magnitude || magnitude < 1e-14) {
    range.lower -= std::max(1.0, magnitude);
    range.upper += std::max(1.0, magnitude);
  }
  return range;
}

/// Raw RGB file for gnuplot, rows from the bottom.
void write_raw(const std::filesystem::path& path, const Image& image) {
  std::string bytes;
  bytes.reserve(image.rgb.size());
  for (int row = image.height - 1; row >= 0; --row) {
    const auto begin = image.rgb.begin() + std::ptrdiff_t{row} * image.width * 3;
    bytes.append(begin, begin + std::ptrdiff_t{image.width} * 3);
  }
  replace_file(path, bytes);
}

void paste(Image& target, const Image& part, int left) {
  for (int row = 0; row < part.height; ++row) {
    const auto begin = part.rgb.begin() + std::ptrdiff_t{row} * part.width * 3;
    std::copy(begin, begin + std::ptrdiff_t{part.width} * 3,
              target.rgb.begin() + (std::ptrdiff_t{row} * target.width + left) * 3);
  }
}

Image colour_bar(const ColourMap& colours, int height) {
  Image image{bar_width, height, {}};
  for (int row = 0; row < height; ++row) {
    const Colour colour = colours.at(1.0 - (row + 0.5) / height);
    for (int column = 0; column < bar_width; ++column) {
      for (const double component : colour) {
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * component)));
      }
    }
  }
  return image;
}

/// What colours stand for.
struct ColourScale {
  Field field;
  ColourRange range;
  ColourMap colours = range.both_signs ? ColourMap::diverging() : ColourMap::sequential();

  /// Gives the shape its colours.
  void apply(Shape& shape) const {
    shape.mesh.shade = (shape.values.array() - range.lower) / (range.upper - range.lower);
  }
};

/// All shapes side by side at one scale.
struct Row {
  Image image;
  int cell_width = 0;
};

Row render_row(const std::vector<Shape>& shapes, const ColourMap& colours, int shape_width) {
  double radius = 0.0;
  for (const Shape& shape : shapes) radius = std::max(radius, shape.mesh.points.rowwise().norm().maxCoeff());
  const Camera camera = camera_for(radius);
  Eigen::Vector2d extent = Eigen::Vector2d::Zero();
  for (const Shape& shape : shapes) extent = extent.cwiseMax(projected_extent(shape.mesh, camera));
  const int n_shapes = static_cast<int>(shapes.size());
  Row row;
  row.cell_width = std::min(shape_width, (widest_picture - bar_room) / n_shapes);
  const double scale = row.cell_width / (2.0 * cell_margin * extent.x());
  const int height = static_cast<int>(std::ceil(2.0 * cell_margin_up * extent.y() * scale));
  row.image = {row.cell_width * n_shapes, height, {}};
  row.image.rgb.assign(static_cast<std::size_t>(row.image.width) * height * 3, 255);
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < n_shapes; ++i) {
    paste(row.image, render(shapes[i].mesh, camera, colours, scale, row.cell_width, height), i * row.cell_width);
  }
  return row;
}

/// The round number (1, 2 or 5 times a power of ten) that puts at most `most` labels on a scale of this length.
double tick_spacing(double length, double most) {
  const double least = length / std::max(most, 2.0);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10.0 * power;
}

/// The row with times below and a colour bar beside it.
void draw_row(const Row& row, const std::vector<double>& times, const ColourScale& scale,
              const std::filesystem::path& picture) {
  const std::filesystem::path folder = picture.parent_path();
  const ColourRange& range = scale.range;
  const TemporaryFile row_file(folder / ".shapes.rgb");
  const TemporaryFile bar_file(folder / ".colours.rgb");
  write_raw(row_file.path(), row.image);
  const int bar_height = std::clamp(row.image.height - 120, 60, 420);
  write_raw(bar_file.path(), colour_bar(scale.colours, bar_height));

  const int width = row.image.width + (scale.field.name.empty() ? 0 : bar_room);
  const int height = row.image.height + label_height;
  const auto across = [&](double pixels) { return pixels / width; };
  const auto upward = [&](double pixels) { return pixels / height; };
  std::string script = fmt::format(
      "set terminal pngcairo size {},{} enhanced font 'Sans,20' background rgb 'white'\n"
      "set output {}\n"
      "set multiplot\n"
      "unset border; unset tics; unset key\n"
      "set lmargin at screen 0; set rmargin at screen {}; set bmargin at screen {}; set tmargin at screen 1\n",
      width, height, gnuplot_quoted(picture.string()), across(row.image.width), upward(label_height));
  for (std::size_t i = 0; i < times.size(); ++i) {
    script += fmt::format("set label {} 't = {:.4g}' at screen {},{} center\n", i + 1, times[i],
                          across((static_cast<double>(i) + 0.5) * row.cell_width), upward(label_height / 2.0));
  }
  script += fmt::format(
      "set xrange [0:{0}]; set yrange [0:{1}]\n"
      "plot {2} binary array=({0},{1}) format='%uchar' origin=(0.5,0.5) using 1:2:3 with rgbimage\n",
      row.image.width, row.image.height, gnuplot_quoted(row_file.path().string()));
  if (!scale.field.name.empty()) {
    const double middle = label_height + row.image.height / 2.0;
    script += fmt::format(
        "unset label\n"
        "set lmargin at screen {}; set rmargin at screen {}; set bmargin at screen {}; set tmargin at screen {}\n",
        across(row.image.width + 24), across(row.image.width + 24 + bar_width), upward(middle - bar_height / 2.0),
        upward(middle + bar_height / 2.0));
    // About one label for every 30 pixels of the bar.
    const double tick = tick_spacing(range.upper - range.lower, bar_height / 30.0);
    script += fmt::format(
        "set border lw 1; set y2tics {6} out nomirror scale 0.6 font ',17'; set format y2 '%.3g'\n"
        "set title {0} offset 0,-0.3\n"
        "set xrange [0:{1}]; set yrange [0:{2}]; set y2range [{3}:{4}]\n"
        "plot {5} binary array=({1},{2}) format='%uchar' origin=(0.5,0.5) using 1:2:3 with rgbimage\n",
        gnuplot_quoted(scale.field.label), bar_width, bar_height, range.lower, range.upper,
        gnuplot_quoted(bar_file.path().string()), tick);
  }
  script += "unset multiplot\n";
  run_gnuplot(script, folder);
}

}  // namespace

std::vector<SnapshotChoice> shapes_to_plot(const PlotTask& task, const RunReader& run) {
  if (task.times.size() > most_shapes) {
    throw InputError(fmt::format("{} times are too many for one row of shapes; accepted: at most {}", task.times.size(),
                                 most_shapes));
  }
  std::vector<SnapshotChoice> all;
  for (const double time : task.times) all.push_back(choose_snapshot(run, task.paths.snapshots(), time));
  const double start = run.times().front(), end = run.times().back();
  for (std::size_t i = 0; task.times.empty() && i < most_shapes; ++i) {
    all.push_back({run.nearest(start + (end - start) * i / (most_shapes - 1.0)), ""});
  }
  std::vector<SnapshotChoice> shapes;
  for (SnapshotChoice& choice : all) {
    const auto same = std::find_if(shapes.begin(), shapes.end(),
                                   [&](const SnapshotChoice& other) { return other.snapshot == choice.snapshot; });
    if (same == shapes.end()) {
      shapes.push_back(std::move(choice));
    } else if (!choice.note.empty()) {
      same->note += (same->note.empty() ? "" : "\n") + choice.note;
    }
  }
  return shapes;
}

void plot_shapes(const PlotTask& task, const std::filesystem::path& picture) {
  const RunReader run(task.paths.snapshots());
  const std::vector<SnapshotChoice> choices = shapes_to_plot(task, run);
  const Field field = field_to_show(run, choices.front().snapshot);
  std::vector<Shape> shapes;
  std::vector<double> times;
  Extremes extremes;
  for (const SnapshotChoice& choice : choices) {
    shapes.push_back(shape_of(run, choice.snapshot, field));
    times.push_back(shapes.back().time);
    extremes.add(shapes.back());
  }
  const ColourScale scale{field, range_of(extremes, field)};
  for (Shape& shape : shapes) scale.apply(shape);
  draw_row(render_row(shapes, scale.colours, task.shape_width), times, scale, picture);
}

FrameDrawer shape_frames(const PlotTask& task, const RunReader& run, const std::vector<std::size_t>& snapshots) {
  const Field field = field_to_show(run, snapshots.front());
  Extremes extremes;
  double radius = 0.0;
  for (const std::size_t snapshot : snapshots) {
    const Shape shape = shape_of(run, snapshot, field);
    extremes.add(shape);
    radius = std::max(radius, shape.mesh.points.rowwise().norm().maxCoeff());
  }
  const ColourScale scale{field, range_of(extremes, field)};
  return [=, &run, width = task.shape_width](std::size_t snapshot, const std::filesystem::path& picture) {
    Shape shape = shape_of(run, snapshot, field);
    scale.apply(shape);
    // The ball that holds every shape fits into the picture.
    const Image image =
        render(shape.mesh, camera_for(radius), scale.colours, width / (2.0 * cell_margin * radius), width, width);
    draw_row({image, width}, {shape.time}, scale, picture);
  };
}

}  // namespace vehd

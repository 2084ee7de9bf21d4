#include "bie/pictures/renderer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vehd {
namespace {

/// Samples per pixel along each direction.
constexpr int oversampling = 3;

/// Light adds up in linear intensity, not in displayed values.
double to_linear(double displayed) { return std::pow(displayed, 2.2); }
double to_displayed(double linear) { return std::pow(std::clamp(linear, 0.0, 1.0), 1.0 / 2.2); }

struct ProjectedPoint {
  double x, y;     ///< in samples, y downwards
  double depth;    ///< towards the eye
  Vector3 normal;  ///< in the frame of the view
  double shade;
};

double power_of_36(double base) {
  const double square = base * base, fourth = square * square, ninth = fourth * fourth * base;
  return ninth * ninth * ninth * ninth;
}

/// Colour of the inside of a cut membrane: paler, so that it is not taken for the outside.
Colour inside_colour(const Colour& base) {
  constexpr double kept = 0.6;
  Colour colour{};
  for (int c = 0; c < 3; ++c) colour[c] = kept * base[c] + (1.0 - kept) * 0.93;
  return colour;
}

/// A colour map in linear intensity, tabulated because powers took most of the time of a picture.
class LinearColours {
 public:
  LinearColours(const ColourMap& colours, bool inside) : nodes_(kNodes + 1) {
    for (int i = 0; i <= kNodes; ++i) {
      Colour displayed = colours.at(static_cast<double>(i) / kNodes);
      if (inside) displayed = inside_colour(displayed);
      for (int c = 0; c < 3; ++c) nodes_[i][c] = to_linear(displayed[c]);
    }
  }

  [[nodiscard]] Colour at(double fraction) const {
    const double place = std::clamp(fraction, 0.0, 1.0) * kNodes;
    const int node = std::min(static_cast<int>(place), kNodes - 1);
    const double share = place - node;
    Colour colour{};
    for (int c = 0; c < 3; ++c) colour[c] = (1.0 - share) * nodes_[node][c] + share * nodes_[node + 1][c];
    return colour;
  }

 private:
  static constexpr int kNodes = 1024;
  std::vector<Colour> nodes_;
};

/// Light on a surface: soft key light from the upper left, weak fill light, a highlight and a slightly darker rim that
/// separates the shape from the white paper.
class Light {
 public:
  /// Colour in linear intensity. @param base  in linear intensity
  [[nodiscard]] Colour on(const Colour& base, const Vector3& normal) const {
    const double facing = std::clamp(normal.z(), 0.0, 1.0);
    const double wrapped = std::max(0.0, (normal.dot(key_) + 0.25) / 1.25);
    const double diffuse = 0.34 + 0.62 * wrapped + 0.14 * std::max(0.0, normal.dot(fill_));
    const double highlight = 0.16 * power_of_36(std::max(0.0, normal.dot(between_)));
    const double rim = 1.0 - 0.35 * (1.0 - facing) * (1.0 - facing) * (1.0 - facing);
    Colour colour{};
    for (int c = 0; c < 3; ++c) colour[c] = base[c] * diffuse * rim + highlight;
    return colour;
  }

 private:
  Vector3 key_ = Vector3(-0.45, 0.62, 0.64).normalized();
  Vector3 fill_ = Vector3(0.75, -0.15, 0.64).normalized();
  Vector3 between_ = (key_ + Vector3::UnitZ()).normalized();  ///< key light and eye
};

/// The visible surface at a sample.
struct Seen {
  Eigen::Vector3f normal;  ///< not yet of unit length
  float shade;
};

class Canvas {
 public:
  Canvas(int width, int height, double nearest)
      : width_(width * oversampling),
        height_(height * oversampling),
        nearest_(nearest),
        depth_(static_cast<std::size_t>(width_) * height_, kNothing),
        seen_(depth_.size()) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  void triangle(const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& c) {
    // Hidden behind the rest of a whole closed surface.
    if (!is_cut() && a.normal.z() < 0.0 && b.normal.z() < 0.0 && c.normal.z() < 0.0) return;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0.0) return;
    const double per_area = 1.0 / area;
    const int left = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
    const int right = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
    const int top = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
    const int bottom = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
    for (int row = top; row <= bottom; ++row) {
      for (int column = left; column <= right; ++column) {
        const double x = column + 0.5, y = row + 0.5;
        const double u = ((b.x - x) * (c.y - y) - (c.x - x) * (b.y - y)) * per_area;
        const double v = ((c.x - x) * (a.y - y) - (a.x - x) * (c.y - y)) * per_area;
        const double w = 1.0 - u - v;
        // Rounding must not exclude a sample on a common edge from both triangles.
        constexpr double rounding = -1e-9;
        if (u < rounding || v < rounding || w < rounding) continue;
        const double depth = u * a.depth + v * b.depth + w * c.depth;
        const std::size_t sample = static_cast<std::size_t>(row) * width_ + column;
        if (depth <= depth_[sample] || depth > nearest_) continue;
        depth_[sample] = depth;
        seen_[sample] = {(u * a.normal + v * b.normal + w * c.normal).cast<float>(),
                         static_cast<float>(u * a.shade + v * b.shade + w * c.shade)};
      }
    }
  }

  [[nodiscard]] Image downsampled(const ColourMap& colours) const {
    const Palette palette{LinearColours(colours, false), LinearColours(colours, true), {}};
    Image image{width_ / oversampling, height_ / oversampling, {}};
    image.rgb.reserve(static_cast<std::size_t>(image.width) * image.height * 3);
    for (int row = 0; row < image.height; ++row) {
      for (int column = 0; column < image.width; ++column) {
        for (const double linear : pixel(row, column, palette)) {
          // Most of a picture is white paper.
          const double displayed = linear >= 1.0 ? 1.0 : to_displayed(linear);
          image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * displayed)));
        }
      }
    }
    return image;
  }

 private:
  static constexpr double kNothing = -std::numeric_limits<double>::infinity();

  struct Palette {
    LinearColours outside, inside;
    Light light;
  };

  [[nodiscard]] bool is_cut() const { return std::isfinite(nearest_); }

  [[nodiscard]] Colour colour(std::size_t sample, const Palette& palette) const {
    if (depth_[sample] == kNothing) return {1.0, 1.0, 1.0};
    const Vector3 normal = seen_[sample].normal.cast<double>().normalized();
    const double shade = seen_[sample].shade;
    const bool inside = is_cut() && normal.z() < 0.0;
    return inside ? palette.light.on(palette.inside.at(shade), -normal)
                  : palette.light.on(palette.outside.at(shade), normal);
  }

  /// Mean of the samples, in linear intensity.
  [[nodiscard]] Colour pixel(int row, int column, const Palette& palette) const {
    const std::size_t first = static_cast<std::size_t>(row * oversampling) * width_ + column * oversampling;
    const auto sample_at = [&](int i, int j) { return first + static_cast<std::size_t>(i) * width_ + j; };
    int n_empty = 0;
    for (int i = 0; i < oversampling; ++i) {
      for (int j = 0; j < oversampling; ++j) n_empty += depth_[sample_at(i, j)] == kNothing ? 1 : 0;
    }
    if (n_empty == oversampling * oversampling) return {1.0, 1.0, 1.0};
    const std::size_t middle = sample_at(oversampling / 2, oversampling / 2);
    if (n_empty == 0 && is_smooth(sample_at(0, 0), sample_at(oversampling - 1, oversampling - 1)) &&
        is_smooth(sample_at(0, oversampling - 1), sample_at(oversampling - 1, 0))) {
      Colour one = colour(middle, palette);
      for (double& component : one) component = std::min(1.0, component);
      return one;
    }
    Colour sum{};
    for (int i = 0; i < oversampling; ++i) {
      for (int j = 0; j < oversampling; ++j) {
        const Colour one = colour(sample_at(i, j), palette);
        for (int c = 0; c < 3; ++c) sum[c] += std::min(1.0, one[c]);
      }
    }
    for (double& component : sum) component /= oversampling * oversampling;
    return sum;
  }

  /// Do two samples belong to one piece of surface whose normal and shade hardly change between them? Then all samples
  /// between them have the light of their middle to one level of 255.
  [[nodiscard]] bool is_smooth(std::size_t a, std::size_t b) const {
    constexpr float bend = 3e-4F, change = 4e-3F;
    const Eigen::Vector3f &n = seen_[a].normal, &m = seen_[b].normal;
    const float product = n.dot(m);
    return product > 0.0F && product * product > (1.0F - bend) * n.squaredNorm() * m.squaredNorm() &&
           std::abs(seen_[a].shade - seen_[b].shade) < change;
  }

  int width_, height_;
  double nearest_;  ///< parts nearer to the eye are left out
  std::vector<double> depth_;
  std::vector<Seen> seen_;
};

}  // namespace

Eigen::Vector2d projected_extent(const RenderMesh& mesh, const Matrix3& view) {
  return (mesh.points * view.topRows<2>().transpose()).cwiseAbs().colwise().maxCoeff().transpose();
}

Image render(const RenderMesh& mesh, const ColourMap& colours, const RenderTask& task) {
  Canvas canvas(task.width, task.height, task.cut ? 0.0 : std::numeric_limits<double>::infinity());
  const double samples = task.scale * oversampling;
  std::vector<ProjectedPoint> points;
  points.reserve(static_cast<std::size_t>(mesh.points.rows()));
  for (Index i = 0; i < mesh.points.rows(); ++i) {
    const Vector3 position = task.view * mesh.points.row(i).transpose();
    points.push_back({0.5 * canvas.width() + samples * position.x(), 0.5 * canvas.height() - samples * position.y(),
                      position.z(), task.view * mesh.normals.row(i).transpose(), mesh.shade(i)});
  }
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    canvas.triangle(points[mesh.triangles[i]], points[mesh.triangles[i + 1]], points[mesh.triangles[i + 2]]);
  }
  return canvas.downsampled(colours);
}

Matrix cut_lines(const RenderMesh& mesh, const Matrix3& view) {
  const Matrix points = mesh.points * view.transpose();
  std::vector<std::array<double, 4>> lines;
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    std::array<double, 4> line{};
    std::size_t n_crossed = 0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const auto a = points.row(mesh.triangles[i + edge]), b = points.row(mesh.triangles[i + (edge + 1) % 3]);
      // A vertex in the plane counts as behind it in all its triangles.
      if ((a(2) > 0.0) == (b(2) > 0.0)) continue;
      const double t = a(2) / (a(2) - b(2));
      line[2 * n_crossed] = a(0) + t * (b(0) - a(0));
      line[2 * n_crossed + 1] = a(1) + t * (b(1) - a(1));
      ++n_crossed;
    }
    if (n_crossed == 2) lines.push_back(line);
  }
  Matrix result(static_cast<Index>(lines.size()), 4);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    result.row(static_cast<Index>(i)) = Eigen::Map<const Eigen::RowVector4d>(lines[i].data());
  }
  return result;
}

}  // namespace vehd

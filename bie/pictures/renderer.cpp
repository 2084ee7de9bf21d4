#include "bie/pictures/renderer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vehd {
namespace {

/// Samples per pixel along each direction.
constexpr int oversampling = 3;

/// Light adds up in linear intensity, not in the numbers of a display.
double to_linear(double displayed) { return std::pow(displayed, 2.2); }
double to_displayed(double linear) { return std::pow(std::clamp(linear, 0.0, 1.0), 1.0 / 2.2); }

struct ProjectedPoint {
  double x, y;              ///< in samples, y downwards
  double inverse_distance;  ///< to the eye plane; linear over a projected triangle
  Vector3 normal;           ///< in the camera frame
  Vector3 position;         ///< in the camera frame
  double shade;
};

double power_of_36(double base) {
  const double square = base * base, fourth = square * square, ninth = fourth * fourth * base;
  return ninth * ninth * ninth * ninth;
}

/// Colour of a surface point: soft key light from the upper left, weak fill light, a highlight and a slightly darker
/// rim that separates the shape from the white paper.
Colour lit_colour(const Colour& base, const Vector3& normal, const Vector3& to_eye) {
  const Vector3 key = Vector3(-0.45, 0.62, 0.64).normalized();
  const Vector3 fill = Vector3(0.75, -0.15, 0.64).normalized();
  const double facing = std::clamp(normal.dot(to_eye), 0.0, 1.0);
  const double wrapped = std::max(0.0, (normal.dot(key) + 0.25) / 1.25);
  const double diffuse = 0.34 + 0.62 * wrapped + 0.14 * std::max(0.0, normal.dot(fill));
  const double highlight = 0.16 * power_of_36(std::max(0.0, normal.dot((key + to_eye).normalized())));
  const double rim = 1.0 - 0.35 * (1.0 - facing) * (1.0 - facing) * (1.0 - facing);
  Colour colour{};
  for (int c = 0; c < 3; ++c) colour[c] = to_linear(base[c]) * diffuse * rim + highlight;
  return colour;
}

class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width * oversampling),
        height_(height * oversampling),
        depth_(static_cast<std::size_t>(width_) * height_, 0.0),
        colour_(depth_.size(), Colour{1.0, 1.0, 1.0}) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  void triangle(const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& c, double eye_distance,
                const ColourMap& colours) {
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0.0) return;
    const int left = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
    const int right = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
    const int top = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
    const int bottom = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
    for (int row = top; row <= bottom; ++row) {
      for (int column = left; column <= right; ++column) {
        const double x = column + 0.5, y = row + 0.5;
        const double u = ((b.x - x) * (c.y - y) - (c.x - x) * (b.y - y)) / area;
        const double v = ((c.x - x) * (a.y - y) - (a.x - x) * (c.y - y)) / area;
        const double w = 1.0 - u - v;
        if (u < 0.0 || v < 0.0 || w < 0.0) continue;
        const double nearness = u * a.inverse_distance + v * b.inverse_distance + w * c.inverse_distance;
        const std::size_t sample = static_cast<std::size_t>(row) * width_ + column;
        if (nearness <= depth_[sample]) continue;
        depth_[sample] = nearness;
        const Vector3 normal = (u * a.normal + v * b.normal + w * c.normal).normalized();
        const Vector3 position = u * a.position + v * b.position + w * c.position;
        const Vector3 to_eye = (Vector3(0.0, 0.0, eye_distance) - position).normalized();
        colour_[sample] = lit_colour(colours.at(u * a.shade + v * b.shade + w * c.shade), normal, to_eye);
      }
    }
  }

  [[nodiscard]] Image downsampled() const {
    Image image{width_ / oversampling, height_ / oversampling, {}};
    image.rgb.reserve(static_cast<std::size_t>(image.width) * image.height * 3);
    for (int row = 0; row < image.height; ++row) {
      for (int column = 0; column < image.width; ++column) {
        for (int c = 0; c < 3; ++c) image.rgb.push_back(pixel(row, column, c));
      }
    }
    return image;
  }

 private:
  [[nodiscard]] std::uint8_t pixel(int row, int column, int component) const {
    double sum = 0.0;
    for (int i = 0; i < oversampling; ++i) {
      for (int j = 0; j < oversampling; ++j) {
        const std::size_t sample =
            static_cast<std::size_t>(row * oversampling + i) * width_ + column * oversampling + j;
        sum += std::min(1.0, colour_[sample][component]);
      }
    }
    return static_cast<std::uint8_t>(std::lround(255.0 * to_displayed(sum / (oversampling * oversampling))));
  }

  int width_, height_;
  std::vector<double> depth_;
  std::vector<Colour> colour_;
};

}  // namespace

Matrix3 camera_frame(const Camera& camera) {
  const double azimuth = camera.azimuth_deg * std::numbers::pi / 180.0;
  const double elevation = camera.elevation_deg * std::numbers::pi / 180.0;
  const Vector3 eye(std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation),
                    std::sin(elevation));
  const Vector3 right(std::cos(azimuth), std::sin(azimuth), 0.0);
  Matrix3 frame;
  frame.row(0) = right;
  frame.row(1) = eye.cross(right);
  frame.row(2) = eye;
  return frame;
}

Eigen::Vector2d projected_extent(const RenderMesh& mesh, const Camera& camera) {
  const Matrix points = mesh.points * camera_frame(camera).transpose();
  Eigen::Vector2d extent = Eigen::Vector2d::Zero();
  for (Index i = 0; i < points.rows(); ++i) {
    const double magnification = camera.distance / (camera.distance - points(i, 2));
    extent.x() = std::max(extent.x(), magnification * std::abs(points(i, 0)));
    extent.y() = std::max(extent.y(), magnification * std::abs(points(i, 1)));
  }
  return extent;
}

Image render(const RenderMesh& mesh, const Camera& camera, const ColourMap& colours, double scale, int width,
             int height) {
  Canvas canvas(width, height);
  const Matrix3 frame = camera_frame(camera);
  std::vector<ProjectedPoint> points;
  points.reserve(static_cast<std::size_t>(mesh.points.rows()));
  for (Index i = 0; i < mesh.points.rows(); ++i) {
    const Vector3 position = frame * mesh.points.row(i).transpose();
    const double inverse_distance = 1.0 / (camera.distance - position.z());
    const double magnification = camera.distance * inverse_distance * scale * oversampling;
    points.push_back({0.5 * canvas.width() + magnification * position.x(),
                      0.5 * canvas.height() - magnification * position.y(), inverse_distance,
                      frame * mesh.normals.row(i).transpose(), position, mesh.shade(i)});
  }
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    canvas.triangle(points[mesh.triangles[i]], points[mesh.triangles[i + 1]], points[mesh.triangles[i + 2]],
                    camera.distance, colours);
  }
  return canvas.downsampled();
}

}  // namespace vehd

#include "bie/comparison/check_samples.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "bie/geometry/surface.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr int directions = 12;
constexpr std::array offsets_in_spacings{-1.0, -0.5, -0.1, 0.1, 0.5, 1.0};
constexpr std::array shares_towards_centre{0.25, 0.6};
constexpr std::array offsets_in_radii{0.7, 1.5, 3.0};

/// Evenly spread over the nodes of the grid: no two on one meridian.
Index spread(int i, Index n) { return static_cast<Index>((i + 0.5) * static_cast<double>(n) / directions); }

}  // namespace

CheckSamples check_samples(const Matrix& position, const std::optional<Wall>& wall) {
  const int order = order_of(position.rows());
  const SphereTransform transform(order, make_grid(order));
  const Surface surface = make_surface(transform, position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  const Vector3 centre = centroid(surface);
  CheckSamples samples;
  samples.near = std::numbers::pi * radius / order;
  std::vector<Vector3> points;
  std::vector<double> distances;
  const auto add = [&](const Vector3& point, double distance) {
    if (wall && !(wall->height(point) > 0.0)) return;
    points.push_back(point);
    distances.push_back(distance);
  };
  for (int i = 0; i < directions; ++i) {
    const Index node = spread(i, surface.n_points());
    const Vector3 x = surface.position.row(node).transpose();
    const Vector3 n = surface.normal.row(node).transpose();
    const double first = offsets_in_spacings[i % offsets_in_spacings.size()] * samples.near;
    add(x + first * n, std::abs(first));
    add(x - first * n, std::abs(first));
    add(centre + shares_towards_centre[i % shares_towards_centre.size()] * (x - centre), 0.0);
    add(x + offsets_in_radii[i % offsets_in_radii.size()] * radius * n, 0.0);
  }
  samples.points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) samples.points.row(static_cast<Index>(i)) = points[i].transpose();
  samples.distance = Eigen::Map<Vector>(distances.data(), static_cast<Index>(distances.size()));
  return samples;
}

Matrix where_possible(const Matrix& points, Index components, std::vector<bool>& is_inside,
                      const std::function<SampleValues(const Matrix&)>& at) {
  Matrix result = Matrix::Constant(points.rows(), components, std::numeric_limits<double>::quiet_NaN());
  is_inside.assign(static_cast<std::size_t>(points.rows()), false);
  const auto take = [&](Index first, Index n) {
    const auto [values, sides] = at(Matrix(points.middleRows(first, n)));
    result.middleRows(first, n) = values;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      is_inside[static_cast<std::size_t>(first) + i] = sides[i] == Side::interior;
    }
  };
  try {
    take(0, points.rows());
  } catch (const ConvergenceError&) {
    for (Index i = 0; i < points.rows(); ++i) {
      try {
        take(i, 1);
      } catch (const ConvergenceError&) {
        // It stays unknown: another part of the membrane is as near, or the degree is too low for the shape.
      }
    }
  }
  return result;
}

}  // namespace vehd

#include "bie/pictures/shape_times.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/pictures/shape_field.hpp"

namespace vehd {
namespace {

/// Degree of the grid on which shapes are compared: no picture needs finer differences.
constexpr int outline_order = 16;
/// Directions from which a shape is measured, over a half sphere.
constexpr int n_directions = 16;
/// Largest number of snapshots that are read.
constexpr std::size_t most_read = 240;

/// Direction i, spread evenly over the half sphere above z = 0 (a Fibonacci spiral).
Vector3 direction_number(int i) {
  const double z = (i + 0.5) / n_directions, radius = std::sqrt(1.0 - z * z);
  const double angle = 2.0 * std::numbers::pi * i / std::numbers::phi;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Lengths that describe the extent of a shape, independent of its position and its grid.
Vector outline_of(const RunReader& run, std::size_t snapshot) {
  const ShapeField& none = shape_field("none");
  const Shape shape = shape_of(read_shape(run.snapshot(snapshot), none), none, outline_order);
  const Vector shares = shape.weights / shape.weights.sum();
  Vector outline(4 * n_directions);
  for (int i = 0; i < n_directions; ++i) {
    // Extents depend only on the hull; the moments also depend on dimples.
    const Vector heights = shape.mesh.points * direction_number(i);
    const Vector squares = heights.cwiseAbs2();
    outline.segment<4>(4 * i) << heights.maxCoeff(), heights.minCoeff(), std::sqrt(squares.dot(shares)),
        std::pow(squares.cwiseAbs2().dot(shares), 0.25);
  }
  return outline;
}

}  // namespace

std::vector<std::size_t> spread_evenly(std::size_t n, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t count = std::min(n, most);
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? 0 : (i * (n - 1) + (count - 1) / 2) / (count - 1));
  }
  return chosen;
}

std::vector<std::size_t> spread_by_change(const std::vector<double>& times, const Matrix& rows, std::size_t most) {
  const std::size_t n = times.size();
  if (n <= 2 || most <= 1)
    return n == 1 || most <= 1 ? std::vector<std::size_t>{0} : std::vector<std::size_t>{0, n - 1};
  std::vector<double> way(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) {
    way[i] = way[i - 1] + (rows.row(static_cast<Index>(i)) - rows.row(static_cast<Index>(i) - 1)).norm();
  }
  const double length = way.back(), duration = times.back() - times.front();
  const double time_share = length > 1e-6 * rows.row(0).norm() ? 0.1 : 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    way[i] = time_share * (duration > 0.0 ? (times[i] - times.front()) / duration : 0.0) +
             (length > 0.0 ? (1.0 - time_share) * way[i] / length : 0.0);
  }
  std::vector<std::size_t> chosen{0};
  for (std::size_t k = 1; k + 1 < most; ++k) {
    const double wanted = way.back() * static_cast<double>(k) / static_cast<double>(most - 1);
    const auto distance = [&](std::size_t i) { return std::abs(way[i] - wanted); };
    std::size_t best = chosen.back();
    for (std::size_t i = chosen.back() + 1; i + 1 < n; ++i) {
      if (best == chosen.back() || distance(i) < distance(best)) best = i;
    }
    // In order, each once: snapshots up to the last chosen one are not considered.
    if (best != chosen.back()) chosen.push_back(best);
  }
  chosen.push_back(n - 1);
  return chosen;
}

std::vector<std::size_t> snapshots_by_change(const RunReader& run, std::size_t most) {
  const std::vector<std::size_t> read = spread_evenly(run.times().size(), most_read);
  const std::size_t n_read = read.size();
  if (n_read <= 2) return read;
  std::vector<double> times;
  for (const std::size_t snapshot : read) times.push_back(run.times()[snapshot]);
  Matrix outlines(static_cast<Index>(n_read), 4 * n_directions);
  for (std::size_t i = 0; i < n_read; ++i) {
    outlines.row(static_cast<Index>(i)) = outline_of(run, read[i]).transpose();
  }
  std::vector<std::size_t> chosen;
  for (const std::size_t i : spread_by_change(times, outlines, most)) chosen.push_back(read[i]);
  return chosen;
}

}  // namespace vehd

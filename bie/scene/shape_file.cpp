#include "bie/scene/shape_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/scene/hdf5_reader.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Times of snapshots are exact multiples of a decimal number up to rounding.
constexpr double time_tolerance = 1e-9;

std::string snapshot_at(const Hdf5Reader& file, std::optional<double> time) {
  const std::vector<std::string> names = file.members("/snapshots");
  if (names.empty()) file.refuse("holds no snapshot");
  if (!time) return "/snapshots/" + names.back();
  const auto distance = [&](const std::string& name) {
    return std::abs(file.number_attribute("/snapshots/" + name, "time") - *time);
  };
  std::string nearest = names.front();
  for (const std::string& name : names) {
    if (distance(name) < distance(nearest)) nearest = name;
  }
  if (!(distance(nearest) <= time_tolerance * std::max(1.0, std::abs(*time)))) {
    file.refuse(fmt::format("no snapshot at time {}; the nearest is at {}", *time,
                            file.number_attribute("/snapshots/" + nearest, "time")));
  }
  return "/snapshots/" + nearest;
}

}  // namespace

Matrix read_shape_file(const std::string& path, std::optional<double> time) {
  const Hdf5Reader file(path);
  const std::string dataset = snapshot_at(file, time) + "/coefficients/x";
  Matrix position = file.matrix(dataset);
  if (position.cols() != 3 || !position.allFinite()) file.refuse(fmt::format("{} is no position", dataset));
  try {
    order_of(position.rows());
  } catch (const ShapeError&) {
    file.refuse(fmt::format("{} has {} coefficients, not the square of order + 1", dataset, position.rows()));
  }
  return position;
}

}  // namespace vehd

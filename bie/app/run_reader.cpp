#include "bie/app/run_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/app/run_file.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Times of snapshots are exact multiples of a decimal number up to rounding.
constexpr double time_tolerance = 1e-9;

}  // namespace

RunReader::RunReader(const std::filesystem::path& path) : file_(path) {
  const std::int64_t version = file_.integer_attribute("/", "schema_version");
  if (version != run_schema_version) {
    file_.refuse(fmt::format("has schema version {}; accepted: {}", version, run_schema_version));
  }
  names_ = file_.members("/snapshots");
  if (names_.empty()) file_.refuse("holds no snapshot");
  for (const std::string& name : names_) times_.push_back(file_.number_attribute("/snapshots/" + name, "time"));
}

std::size_t RunReader::nearest(double time) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < times_.size(); ++i) {
    if (std::abs(times_[i] - time) < std::abs(times_[best] - time)) best = i;
  }
  return best;
}

std::size_t RunReader::at(double time) const {
  const std::size_t snapshot = nearest(time);
  if (!(std::abs(times_[snapshot] - time) <= time_tolerance * std::max(1.0, std::abs(time)))) {
    file_.refuse(fmt::format("no snapshot at time {:g}; the nearest is at {:g}", time, times_[snapshot]));
  }
  return snapshot;
}

std::string RunReader::path_of(std::size_t snapshot, const std::string& name) const {
  return "/snapshots/" + names_.at(snapshot) + "/coefficients/" + name;
}

bool RunReader::has_field(std::size_t snapshot, const std::string& name) const {
  return file_.has(path_of(snapshot, name));
}

Matrix RunReader::coefficients(std::size_t snapshot, const std::string& name) const {
  Matrix values = file_.matrix(path_of(snapshot, name));
  try {
    order_of(values.rows());
  } catch (const ShapeError& error) {
    file_.refuse(fmt::format("{}: {}", path_of(snapshot, name), error.what()));
  }
  if (!values.allFinite()) file_.refuse(fmt::format("{} holds values that are not finite", path_of(snapshot, name)));
  return values;
}

Matrix RunReader::coefficients(std::size_t snapshot, const std::string& name, Index components) const {
  Matrix values = coefficients(snapshot, name);
  const Index rows = name == "x" ? values.rows() : file_.matrix(path_of(snapshot, "x")).rows();
  if (values.cols() != components || values.rows() != rows) {
    file_.refuse(fmt::format("{} is {} x {}, but must be {} x {}", path_of(snapshot, name), values.cols(),
                             values.rows(), components, rows));
  }
  return values;
}

}  // namespace vehd

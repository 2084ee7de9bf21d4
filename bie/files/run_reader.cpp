#include "bie/files/run_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "bie/sphere/degrees.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/checksum.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Times of snapshots are exact multiples of a decimal number up to rounding; relative to the longest of them.
constexpr double time_tolerance = 1e-9;

}  // namespace

void require_run_schema(const Hdf5Reader& file) {
  const std::int64_t version = file.integer_attribute("/", "schema_version");
  if (version == run_schema_version) return;
  file.refuse(fmt::format("has schema version {}; accepted: {}", version, run_schema_version));
}

std::vector<std::string> vesicle_groups(const Hdf5Reader& file, const std::string& group) {
  const std::string of_several = group + "/vesicles";
  if (!file.has(of_several)) return {group};
  std::vector<std::string> groups;
  for (std::size_t a = 0; a < file.members(of_several).size(); ++a) {
    groups.push_back(fmt::format("{}/{:02d}", of_several, a));
  }
  return groups;
}

std::int64_t snapshot_checksum(const Hdf5Reader& file, const std::string& group) {
  const double time = file.number_attribute(group, "time");
  Checksum checksum;
  checksum.add(std::span(&time, 1));
  checksum.add(file.integer_attribute(group, "step"));
  for (const std::string& vesicle : vesicle_groups(file, group)) {
    if (file.has_attribute(vesicle, degree_attribute)) checksum.add(file.integer_attribute(vesicle, degree_attribute));
    for (const std::string_view field : snapshot_fields) {
      for (const std::string_view part : snapshot_parts) {
        const std::string dataset = fmt::format("{}/{}{}", vesicle, part, field);
        if (!file.has(dataset)) continue;
        const Vector values = file.vector(dataset);
        checksum.add(std::span(values.data(), static_cast<std::size_t>(values.size())));
      }
    }
  }
  return checksum.value();
}

int solved_degree(const Hdf5Reader& file, const std::string& vesicle) {
  const int of_file = order_of(file.matrix(vesicle + "/coefficients/x").rows());
  if (!file.has_attribute(vesicle, degree_attribute)) return of_file;
  const std::int64_t degree = file.integer_attribute(vesicle, degree_attribute);
  if (degree >= lowest_order && degree <= of_file) return static_cast<int>(degree);
  file.refuse(fmt::format("{} has the degree {}; accepted: {} to {}", vesicle, degree, lowest_order, of_file));
}

void require_checksum(const Hdf5Reader& file, const std::string& group, std::int64_t checksum) {
  if (file.integer_attribute(group, "checksum") == checksum) return;
  file.refuse(fmt::format("{} is damaged: its values do not match their checksum", group));
}

RunReader::RunReader(Hdf5Reader file) : file_(std::move(file)) {
  require_run_schema(file_);
  names_ = file_.members("/snapshots");
  if (names_.empty()) file_.refuse("holds no snapshot");
  for (const std::string& name : names_) {
    times_.push_back(file_.number_attribute("/snapshots/" + name, "time"));
    if (!std::isfinite(times_.back())) {
      file_.refuse(fmt::format("/snapshots/{} has the time {}, not a finite number", name, times_.back()));
    }
  }
  n_vesicles_ = vesicle_groups(file_, group_of(0)).size();
}

std::size_t RunReader::nearest(double time) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < times_.size(); ++i) {
    if (std::abs(times_[i] - time) < std::abs(times_[best] - time)) best = i;
  }
  return best;
}

std::optional<std::size_t> RunReader::find(double time) const {
  const std::size_t snapshot = nearest(time);
  double longest = std::abs(time);
  for (const double each : times_) longest = std::max(longest, std::abs(each));
  if (!(std::abs(times_[snapshot] - time) <= time_tolerance * longest)) return std::nullopt;
  return snapshot;
}

std::size_t RunReader::at(double time) const {
  if (const auto snapshot = find(time)) return *snapshot;
  file_.refuse(fmt::format("no snapshot at time {:g}; the nearest is at {:g}", time, times_[nearest(time)]));
}

std::string RunReader::vesicle_group_of(std::size_t snapshot, std::size_t vesicle) const {
  return group_of(snapshot) + (n_vesicles_ > 1 ? fmt::format("/vesicles/{:02d}", vesicle) : "");
}

std::string RunReader::path_of(std::size_t snapshot, const std::string& name, std::size_t vesicle) const {
  return vesicle_group_of(snapshot, vesicle) + "/coefficients/" + name;
}

void RunReader::require_one_vesicle(const std::string& who) const {
  if (n_vesicles_ == 1) return;
  file_.refuse(fmt::format("holds {} vesicles; {} accepts a run of one", n_vesicles_, who));
}

bool RunReader::has_field(std::size_t snapshot, const std::string& name) const {
  return file_.has(path_of(snapshot, name, 0));
}

void RunReader::require_sealed(std::size_t snapshot) const {
  const std::string group = group_of(snapshot);
  if (file_.has_attribute(group, "checksum")) return;
  file_.refuse(fmt::format("{} has no checksum, so that its numbers cannot be told from damaged ones", group));
}

Matrix RunReader::read(std::size_t snapshot, const std::string& name, std::size_t vesicle) const {
  if (file_.has_attribute(group_of(snapshot), "checksum")) {
    require_checksum(file_, group_of(snapshot), snapshot_checksum(file_, group_of(snapshot)));
  }
  Matrix values = file_.matrix(path_of(snapshot, name, vesicle));
  try {
    const int order = order_of(values.rows());
    if (order > highest_order) {
      file_.refuse(fmt::format("{} is of degree {}; accepted: at most {}", path_of(snapshot, name, vesicle), order,
                               highest_order));
    }
  } catch (const ShapeError& error) {
    file_.refuse(fmt::format("{}: {}", path_of(snapshot, name, vesicle), error.what()));
  }
  if (!values.allFinite())
    file_.refuse(fmt::format("{} holds values that are not finite", path_of(snapshot, name, vesicle)));
  return values;
}

Matrix RunReader::coefficients(std::size_t snapshot, const std::string& name, Index components,
                               std::size_t vesicle) const {
  if (!file_.has(path_of(snapshot, name, vesicle))) {
    file_.refuse(fmt::format("dataset {} is missing; expected: coefficients with {} component{}",
                             path_of(snapshot, name, vesicle), components, components == 1 ? "" : "s"));
  }
  Matrix values = read(snapshot, name, vesicle);
  const Index rows = name == "x" ? values.rows() : file_.matrix(path_of(snapshot, "x", vesicle)).rows();
  if (values.cols() != components || values.rows() != rows) {
    file_.refuse(fmt::format("{} is {} x {}, but must be {} x {}", path_of(snapshot, name, vesicle), values.cols(),
                             values.rows(), components, rows));
  }
  return values;
}

}  // namespace vehd

#include "bie/files/run_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bie/sphere/degrees.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/support/checksum.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Times of snapshots are multiples of a decimal number up to rounding; relative to the largest of them.
constexpr double time_tolerance = 1e-9;

}  // namespace

std::vector<SnapshotField> snapshot_fields() {
  std::vector<SnapshotField> result;
  const auto add = [&](const FieldRow& row, const auto&) {
    if (!row.dataset.empty()) result.push_back({std::string(row.dataset), row.kind == FieldKind::vector});
  };
  const SurfaceFields state;
  const VesicleFields fields;
  for_each_field(add, state);
  for_each_field(add, fields);
  for (const char* name : {"Vm_amplitude", "Vm_phase_deg", "Vm_real", "Vm_imaginary", "q_amplitude", "q_real",
                           "q_imaginary", "area_element"}) {
    result.push_back({name});
  }
  return result;
}

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

RunReader::RunReader(Hdf5Reader file) : file_(std::move(file)) {
  require_run_schema(file_);
  names_ = file_.members("/snapshots");
  const auto has_seal = [&](const std::string& name) { return file_.has(seal_path("/snapshots/" + name)); };
  // A single remaining seal shows that the others were lost.
  is_sealed_ = file_.has(seal_path("/")) || std::ranges::any_of(names_, has_seal);
  require_sealed("/", "/snapshots");
  if (names_.empty()) file_.refuse("holds no snapshot");
  for (const std::string& name : names_) {
    const std::string group = "/snapshots/" + name;
    if (const std::string expected = fmt::format("/snapshots/{:06d}", times_.size()); group != expected) {
      file_.refuse(fmt::format("lacks {}", expected));
    }
    // The choice of a snapshot depends on the times of all of them, which are attributes of their groups.
    require_sealed(group, group);
    times_.push_back(file_.number_attribute(group, "time"));
    if (!std::isfinite(times_.back())) {
      file_.refuse(fmt::format("{} has the time {}, not a finite number", group, times_.back()));
    }
  }
  n_vesicles_ = vesicle_groups(file_, "/snapshots/" + names_.front()).size();
}

std::string RunReader::seal_of(const std::string& group) const {
  if (!file_.has(seal_path(group))) file_.refuse(fmt::format("{} has lost its seal, {}", group, seal_path(group)));
  return file_.text(seal_path(group));
}

void RunReader::require_sealed(const std::string& group, const std::string& closed) const {
  if (!is_sealed_) return;
  std::string seal = seal_of(group);
  // The first line of the seal is that of the group.
  if (group == closed) seal.resize(std::min(seal.size(), seal.find('\n')));
  if (const std::string found = differences(seal, file_.object_checksums(group, closed)); !found.empty()) {
    file_.refuse("damaged or altered: " + found);
  }
}

RunSnapshot RunReader::snapshot(std::size_t number) const {
  const std::string group = "/snapshots/" + names_.at(number);
  require_sealed(group, {});
  return {file_, group, times_[number], n_vesicles_};
}

int RunReader::order() const {
  return static_cast<int>(std::clamp<std::int64_t>(file_.integer_attribute("/", "order"), 0, highest_order));
}

std::int64_t RunReader::checksum(std::size_t count) const {
  Checksum all;
  if (!is_sealed_) return all.value();
  for (std::size_t i = 0; i < std::min(count, names_.size()); ++i) {
    all.add(seal_checksum(seal_of("/snapshots/" + names_[i])));
  }
  return all.value();
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

void RunReader::require_one_vesicle(const std::string& who) const {
  if (n_vesicles_ == 1) return;
  file_.refuse(fmt::format("holds {} vesicles; {} accepts a run of one", n_vesicles_, who));
}

std::optional<std::int64_t> RunSnapshot::checksum() const {
  if (!file_.has(seal_path(group_))) return std::nullopt;
  return seal_checksum(file_.text(seal_path(group_)));
}

std::string RunSnapshot::group_of(std::size_t vesicle) const {
  return group_ + (n_vesicles_ > 1 ? fmt::format("/vesicles/{:02d}", vesicle) : "");
}

int RunSnapshot::degree(std::size_t vesicle) const {
  const int of_file = order_of(read("x", vesicle).rows());
  if (!file_.has_attribute(group_of(vesicle), degree_attribute)) return of_file;
  const std::int64_t degree = file_.integer_attribute(group_of(vesicle), degree_attribute);
  if (degree >= lowest_order && degree <= of_file) return static_cast<int>(degree);
  file_.refuse(
      fmt::format("{} has the degree {}; accepted: {} to {}", group_of(vesicle), degree, lowest_order, of_file));
}

Matrix RunSnapshot::read(const std::string& field, std::size_t vesicle) const {
  const std::string path = path_of(field, vesicle);
  Matrix values = file_.matrix(path);
  try {
    const int order = order_of(values.rows());
    if (order > highest_order) {
      file_.refuse(fmt::format("{} is of degree {}; accepted: at most {}", path, order, highest_order));
    }
  } catch (const ShapeError& error) {
    file_.refuse(fmt::format("{}: {}", path, error.what()));
  }
  if (!values.allFinite()) file_.refuse(fmt::format("{} holds values that are not finite", path));
  return values;
}

Matrix RunSnapshot::coefficients(const std::string& field, Index components, std::size_t vesicle) const {
  if (!file_.has(path_of(field, vesicle))) {
    file_.refuse(fmt::format("dataset {} is missing; expected: coefficients with {} component{}",
                             path_of(field, vesicle), components, components == 1 ? "" : "s"));
  }
  Matrix values = read(field, vesicle);
  const Index rows = field == "x" ? values.rows() : file_.matrix(path_of("x", vesicle)).rows();
  if (values.cols() != components || values.rows() != rows) {
    file_.refuse(fmt::format("{} is {} x {}, but must be {} x {}", path_of(field, vesicle), values.cols(),
                             values.rows(), components, rows));
  }
  return values;
}

namespace {

/// Distance from a snapshot to its neighbour on the side of the time, or at an end to its only one; 0 if it has none.
double spacing_at(const std::vector<double>& times, std::size_t snapshot, double time) {
  const std::size_t last = times.size() - 1;
  if (last == 0) return 0.0;
  const std::size_t right = std::clamp<std::size_t>(time < times[snapshot] ? snapshot : snapshot + 1, 1, last);
  return times[right] - times[right - 1];
}

}  // namespace

std::string shown_time(double time, const SiUnit& unit) {
  const std::string number = fmt::format("{:.10g}", time * unit.scale);
  return unit.symbol == "1" ? number : number + " " + unit.symbol;
}

SnapshotChoice choose_snapshot(const RunReader& run, const std::filesystem::path& file, std::optional<double> time,
                               const SiUnit& shown) {
  const std::vector<double>& times = run.times();
  if (!time) return {times.size() - 1, ""};
  const std::size_t snapshot = run.nearest(*time);
  const double spacing = spacing_at(times, snapshot, *time);
  const double distance = std::abs(times[snapshot] - *time);
  const auto text = [&shown](double of) { return shown_time(of, shown); };
  const double same = time_tolerance * std::max(spacing, std::abs(*time));
  if (distance <= same) return {snapshot, ""};
  // Written so that NaN is refused.
  if (!(distance <= 0.5 * spacing + same)) {
    throw InputError(fmt::format("{}: no snapshot near time {}; there are {} from {} to {}, the nearest at {}",
                                 file.string(), text(*time), times.size(), text(times.front()), text(times.back()),
                                 text(times[snapshot])));
  }
  return {snapshot, fmt::format("{}: no snapshot at time {}; taken: the nearest, at {}", file.string(), text(*time),
                                text(times[snapshot]))};
}

}  // namespace vehd

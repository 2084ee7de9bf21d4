#include "bie/comparison/stored_copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "bie/files/hdf5_writer.hpp"
#include "bie/files/run_file.hpp"
#include "bie/runs/snapshot_copy.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

/// Compares a file with one computed from its coefficients.
class CopyCheck {
 public:
  CopyCheck(const Hdf5Reader& stored, const Hdf5Reader& expected, int order)
      : stored_(stored), expected_(expected), rounding_(rounding_of(order)) {}

  /// Compares all objects from a group down. @param closed  see Hdf5Reader::object_checksums
  void require(const std::string& group, const std::string& closed) const {
    const ObjectChecksums objects = stored_.object_checksums(group, closed);
    for (const auto& [path, checksum] : expected_.object_checksums(group, closed)) {
      const auto object = objects.find(path);
      if (object == objects.end()) refuse(path, "is missing");
      // Equal checksums need equal bits; another machine rounds differently.
      if (object->second != checksum) compare(path);
    }
    for (const auto& [path, checksum] : objects) {
      if (is_field(path) && !expected_.has(path)) refuse(path, "has no coefficients");
    }
  }

  /// Compares two attributes of an object, the text of a unit and its scale.
  void require_unit(const std::string& object, const std::string& unit, const std::string& scale) const {
    const double expected = expected_.number_attribute(object, scale);
    if (stored_.text_attribute(object, unit) != expected_.text_attribute(object, unit) ||
        !(std::abs(stored_.number_attribute(object, scale) - expected) <= rounding_ * std::abs(expected))) {
      refuse(object, fmt::format("has another {} or {}", unit, scale));
    }
  }

 private:
  /// A value is a sum of (p + 1)² terms, and an area element has two derivatives, each of which grows with p + 1.
  static double rounding_of(int order) { return std::numeric_limits<double>::epsilon() * std::pow(order + 1.0, 4); }

  [[noreturn]] void refuse(const std::string& path, const std::string& problem) const {
    stored_.refuse(fmt::format("{} {}; it does not follow from the coefficients of the run", path, problem));
  }

  static bool is_field(const std::string& path) {
    static const std::vector<SnapshotField> fields = snapshot_fields();
    return std::ranges::find(fields, path.substr(path.rfind('/') + 1), &SnapshotField::name) != fields.end();
  }

  void compare(const std::string& path) const {
    // Attributes of groups, and texts, are not computed from coefficients.
    if (!expected_.has_attribute(path, "scale")) return;
    require_unit(path, "unit", "scale");
    if (!expected_.holds_numbers(path)) {
      // Indices have no rounding.
      if (stored_.dataset_checksum(path) != expected_.dataset_checksum(path)) refuse(path, "has other values");
      return;
    }
    const Matrix stored = stored_.matrix(path), expected = expected_.matrix(path);
    if (stored.rows() != expected.rows() || stored.cols() != expected.cols()) refuse(path, "has another shape");
    const double largest = is_phase(path) ? 180.0 : expected.cwiseAbs().maxCoeff();
    const Vector weights = weights_of(path, expected.size());
    for (Index i = 0; i < expected.size(); ++i) {
      double difference = stored.reshaped()[i] - expected.reshaped()[i];
      if (is_phase(path)) difference = std::remainder(difference, 360.0);
      if (!(std::abs(difference) * weights[i] <= rounding_ * largest)) {
        refuse(path, fmt::format("has {:.17g} in place of {:.17g}", stored.reshaped()[i], expected.reshaped()[i]));
      }
    }
  }

  static bool is_phase(const std::string& path) { return path.ends_with("_phase_deg"); }

  /// A phase has no accuracy where its amplitude vanishes.
  [[nodiscard]] Vector weights_of(const std::string& path, Index size) const {
    if (!is_phase(path)) return Vector::Ones(size);
    const std::string amplitude = path.substr(0, path.rfind("_phase_deg")) + "_amplitude";
    const Vector sizes = expected_.vector(amplitude);
    return sizes / sizes.maxCoeff();
  }

  const Hdf5Reader& stored_;
  const Hdf5Reader& expected_;
  double rounding_;
};

}  // namespace

void require_copies(const RunReader& run, std::size_t snapshot) {
  const std::string name = snapshot_name(static_cast<std::int64_t>(snapshot));
  const SiUnits si_units = si_units_of(units_of(run));
  const SphereTransform transform(run.order(), make_grid(run.order()));
  Hdf5Writer copy(run.name(), Hdf5Writer::Mode::in_memory);
  write_run_header(copy, transform, {run.has_scene() ? run.scene() : "", 1, si_units});
  copy_snapshot(copy, run, snapshot, transform, si_units);
  const Hdf5Reader expected(copy.image(), run.name());
  const CopyCheck check(run.file(), expected, run.order());
  check.require_unit("/snapshots", "time_unit", "time_scale");
  for (const char* group : {"/grid", "/surface", "/coefficients_convention"}) check.require(group, {});
  check.require("/snapshots/" + name, {});
}

}  // namespace vehd

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bie/files/hdf5_reader.hpp"
#include "bie/files/si_unit.hpp"

namespace vehd {

/// Version of the layout of run.h5 that this program reads and writes.
constexpr std::int64_t run_schema_version = 1;

struct SnapshotField {
  std::string name;
  bool is_vector = false;
};

/// Datasets that a snapshot can have for a vesicle: the fields of the field table, and those derived from amplitudes
/// and the shape.
std::vector<SnapshotField> snapshot_fields();
/// Parts of a snapshot that have each of them.
constexpr std::array<std::string_view, 3> snapshot_parts = {"", "coefficients/", "surface/"};

/// @throws InputError if the file is of another schema version
void require_run_schema(const Hdf5Reader& file);

/// Groups of the vesicles of a snapshot; with one vesicle, that of the snapshot itself.
std::vector<std::string> vesicle_groups(const Hdf5Reader& file, const std::string& group);

/// Attribute of a vesicle of a snapshot: the degree at which it was solved, above which its coefficients are zero.
constexpr const char* degree_attribute = "degree";

/// One intact snapshot of a run.h5: it matches its seal, or an earlier vehd wrote the file without seals.
class RunSnapshot {
 public:
  [[nodiscard]] double time() const { return time_; }
  /// Name of the file in messages.
  [[nodiscard]] const std::string& name() const { return file_.name(); }
  [[nodiscard]] std::size_t n_vesicles() const { return n_vesicles_; }
  /// Checksum of its seal; nullopt without seals.
  [[nodiscard]] std::optional<std::int64_t> checksum() const;
  /// Number of steps of the run until this snapshot.
  /// @throws InputError
  [[nodiscard]] std::int64_t step() const { return file_.integer_attribute(group_, "step"); }
  /// Whether it has the coefficients of this field.
  /// @param vesicle  number of the vesicle
  [[nodiscard]] bool has_field(const std::string& field, std::size_t vesicle = 0) const {
    return file_.has(path_of(field, vesicle));
  }
  /// Degree at which a vesicle was solved; with a tolerance usually lower than that of the file. It is that of the file
  /// if an earlier vehd wrote it, without this attribute.
  /// @throws InputError if x cannot have this degree
  [[nodiscard]] int degree(std::size_t vesicle = 0) const;
  /// Harmonic coefficients, [n_coefficients x components].
  /// @throws InputError
  [[nodiscard]] Matrix coefficients(const std::string& field) const { return read(field, 0); }
  /// Coefficients, [n_coefficients x components], which must have the degree of x.
  /// @throws InputError if they do not
  /// @param vesicle  number of the vesicle
  [[nodiscard]] Matrix coefficients(const std::string& field, Index components, std::size_t vesicle = 0) const;

 private:
  friend class RunReader;
  RunSnapshot(const Hdf5Reader& file, std::string group, double time, std::size_t n_vesicles)
      : file_(file), group_(std::move(group)), time_(time), n_vesicles_(n_vesicles) {}
  [[nodiscard]] Matrix read(const std::string& field, std::size_t vesicle) const;
  [[nodiscard]] std::string group_of(std::size_t vesicle) const;
  [[nodiscard]] std::string path_of(const std::string& field, std::size_t vesicle) const {
    return group_of(vesicle) + "/coefficients/" + field;
  }

  const Hdf5Reader& file_;
  std::string group_;
  double time_;
  std::size_t n_vesicles_;
};

/// Reads the snapshots of a run.h5. Its header and times are compared with their seals on opening, each snapshot when
/// it is requested. A file of an earlier vehd has no seals and is read without these checks.
/// @throws InputError
class RunReader {
 public:
  explicit RunReader(Hdf5Reader file);
  explicit RunReader(const std::filesystem::path& path) : RunReader(Hdf5Reader(path)) {}

  /// Times of the snapshots, ascending.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  /// Number of the snapshot whose time is nearest.
  [[nodiscard]] std::size_t nearest(double time) const;
  /// Number of the snapshot at this time, up to the rounding of decimal numbers; nullopt if there is none.
  [[nodiscard]] std::optional<std::size_t> find(double time) const;
  /// Number of the snapshot at this time, see find.
  /// @throws InputError if there is none
  [[nodiscard]] std::size_t at(double time) const;
  /// A snapshot; it must not outlive the reader.
  /// @throws InputError naming the object that does not match its seal
  [[nodiscard]] RunSnapshot snapshot(std::size_t number) const;
  /// Path of the file, or its name in messages.
  [[nodiscard]] const std::string& name() const { return file_.name(); }
  [[nodiscard]] const Hdf5Reader& file() const { return file_; }
  /// Degree of the grid.
  [[nodiscard]] int order() const;
  /// Whether the file contains the scene of the run.
  [[nodiscard]] bool has_scene() const { return file_.has("/scene"); }
  /// The effective scene of the run.
  [[nodiscard]] std::string scene() const { return file_.text("/scene"); }
  /// Number of vesicles in the run.
  [[nodiscard]] std::size_t n_vesicles() const { return n_vesicles_; }
  /// @param who  command that does not support several vesicles, "vehd mesh"
  /// @throws InputError if there are several
  void require_one_vesicle(const std::string& who) const;
  /// Whether the file has seals; without them damage goes unnoticed.
  [[nodiscard]] bool is_sealed() const { return is_sealed_; }
  /// Checksum of the seals of the first snapshots, at most as many as there are.
  [[nodiscard]] std::int64_t checksum(std::size_t count) const;

 private:
  [[nodiscard]] std::string seal_of(const std::string& group) const;
  void require_sealed(const std::string& group, const std::string& closed) const;

  Hdf5Reader file_;
  std::vector<std::string> names_;
  std::vector<double> times_;
  std::size_t n_vesicles_ = 1;
  bool is_sealed_ = false;
};

/// The snapshot chosen for a requested time.
struct SnapshotChoice {
  std::size_t snapshot = 0;
  std::string note;  ///< states the time of the snapshot; empty if it is the requested one
};

/// Text of a time of a run in a unit, for messages and as input.
std::string shown_time(double time, const SiUnit& unit);

/// The snapshot nearest to a time, at most half the distance of neighbouring snapshots there away: any time within a
/// run has one, a time well before or after has none. Without a time, the last snapshot.
/// @param file  from which `run` was read, for messages
/// @param shown  unit of the times in messages
/// @throws InputError naming the first, the last and the nearest time of a snapshot
SnapshotChoice choose_snapshot(const RunReader& run, const std::filesystem::path& file, std::optional<double> time,
                               const SiUnit& shown = {});

}  // namespace vehd

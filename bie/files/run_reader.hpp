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

/// Datasets that a snapshot may have of a vesicle: the fields of the table, and those derived from amplitudes and the
/// shape.
std::vector<SnapshotField> snapshot_fields();
/// Where a snapshot has each of them.
constexpr std::array<std::string_view, 3> snapshot_parts = {"", "coefficients/", "surface/"};

/// @throws InputError if the file is of another schema version
void require_run_schema(const Hdf5Reader& file);

/// Groups of the vesicles of a snapshot: that of the snapshot itself where there is one vesicle.
std::vector<std::string> vesicle_groups(const Hdf5Reader& file, const std::string& group);

/// Attribute of a vesicle of a snapshot: the degree that it was solved in, beyond which its coefficients are zero.
constexpr const char* degree_attribute = "degree";

/// One snapshot of a run.h5 that is intact: it matches its seal, or the file is of an earlier vehd and has none.
class RunSnapshot {
 public:
  [[nodiscard]] double time() const { return time_; }
  /// The file in messages.
  [[nodiscard]] const std::string& name() const { return file_.name(); }
  [[nodiscard]] std::size_t n_vesicles() const { return n_vesicles_; }
  /// Steps of the run until then.
  /// @throws InputError
  [[nodiscard]] std::int64_t step() const { return file_.integer_attribute(group_, "step"); }
  /// Whether it has the coefficients of this field.
  /// @param vesicle  of several
  [[nodiscard]] bool has_field(const std::string& field, std::size_t vesicle = 0) const {
    return file_.has(path_of(field, vesicle));
  }
  /// The degree that a vesicle was solved in: with a tolerance it is lower than that of the file, as a rule. A file of
  /// an earlier program does not have it: that of the file.
  /// @throws InputError if it is none that x can have
  [[nodiscard]] int degree(std::size_t vesicle = 0) const;
  /// Harmonic coefficients, [n_coefficients x components].
  /// @throws InputError
  [[nodiscard]] Matrix coefficients(const std::string& field) const { return read(field, 0); }
  /// Coefficients with the stated number of components and the order of x.
  /// @throws InputError if they differ
  /// @param vesicle  of several
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

/// Access to the snapshots of a run.h5, whose header and times are compared with their seals at once, and each snapshot
/// when it is opened. A file of an earlier vehd has no seals and is read as it is.
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
  /// A snapshot, which must not outlive the reader.
  /// @throws InputError naming the object that does not match its seal
  [[nodiscard]] RunSnapshot snapshot(std::size_t number) const;
  /// The path of the file, or its name in messages.
  [[nodiscard]] const std::string& name() const { return file_.name(); }
  [[nodiscard]] const Hdf5Reader& file() const { return file_; }
  /// Degree of the grid.
  [[nodiscard]] int order() const;
  /// Whether the run has kept its scene.
  [[nodiscard]] bool has_scene() const { return file_.has("/scene"); }
  /// The effective scene of the run.
  [[nodiscard]] std::string scene() const { return file_.text("/scene"); }
  /// How many vesicles the run has.
  [[nodiscard]] std::size_t n_vesicles() const { return n_vesicles_; }
  /// @param who  cannot do with several vesicles, "vehd mesh"
  /// @throws InputError if there are
  void require_one_vesicle(const std::string& who) const;
  /// Whether the file has seals, without which damage goes unnoticed.
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

/// The snapshot that stands for a time which was asked for.
struct SnapshotChoice {
  std::size_t snapshot = 0;
  std::string note;  ///< which other time it has; empty if it has that very time
};

/// A time of a run in a unit, as messages write it and as it may be given.
std::string shown_time(double time, const SiUnit& unit);

/// The nearest snapshot, provided that it is not farther than half the distance of neighbouring snapshots there: any
/// time within a run has one, a time well before or after has none. Without a time, the last snapshot.
/// @param file  that `run` was read from, for messages
/// @param shown  unit of the times in messages
/// @throws InputError naming the times between which the snapshots are, and the nearest one
SnapshotChoice choose_snapshot(const RunReader& run, const std::filesystem::path& file, std::optional<double> time,
                               const SiUnit& shown = {});

}  // namespace vehd

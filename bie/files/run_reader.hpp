#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bie/files/hdf5_reader.hpp"

namespace vehd {

/// Version of the layout of run.h5 that this program reads and writes.
constexpr std::int64_t run_schema_version = 1;

/// Datasets that a snapshot may have, in the order in which its checksum takes them; each on the grid, in coefficients/
/// and in surface/.
constexpr std::array<std::string_view, 26> snapshot_fields = {"x",
                                                              "velocity",
                                                              "force_bending",
                                                              "force_tension",
                                                              "force_electric",
                                                              "force_contact",
                                                              "Vm",
                                                              "q",
                                                              "free_charge_in",
                                                              "free_charge_out",
                                                              "Vm_amplitude",
                                                              "Vm_phase_deg",
                                                              "Vm_real",
                                                              "Vm_imaginary",
                                                              "q_amplitude",
                                                              "q_real",
                                                              "q_imaginary",
                                                              "poration",
                                                              "conductance",
                                                              "tension",
                                                              "area_strain",
                                                              "area_element",
                                                              "capacitance",
                                                              "pump_current",
                                                              "bending_modulus",
                                                              "spontaneous_curvature"};
/// Where a snapshot has each of them.
constexpr std::array<std::string_view, 3> snapshot_parts = {"", "coefficients/", "surface/"};

/// @throws InputError if the file is of another schema version
void require_run_schema(const Hdf5Reader& file);

/// Groups of the vesicles of a snapshot: that of the snapshot itself where there is one vesicle.
std::vector<std::string> vesicle_groups(const Hdf5Reader& file, const std::string& group);

/// Attribute of a vesicle of a snapshot: the degree that it was solved in, beyond which its coefficients are zero.
constexpr const char* degree_attribute = "degree";

/// That degree: with a tolerance it is lower than that of the file, as a rule. A file of an earlier program does not
/// have it: that of the file. @throws InputError if it is none that the coefficients can have
/// @param vesicle  its group, which has x
int solved_degree(const Hdf5Reader& file, const std::string& vesicle);

/// Checksum of time, step, degrees and all numbers of a snapshot as they are in the file.
std::int64_t snapshot_checksum(const Hdf5Reader& file, const std::string& group);

/// @throws InputError if the snapshot's attribute "checksum" says otherwise
void require_checksum(const Hdf5Reader& file, const std::string& group, std::int64_t checksum);

/// Access to the snapshots of a run.h5. @throws InputError
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
  /// The same. @throws InputError if there is none
  [[nodiscard]] std::size_t at(double time) const;
  /// The path of the file, or what stands for it in messages.
  [[nodiscard]] const std::string& name() const { return file_.name(); }
  /// Whether the run has kept its scene.
  [[nodiscard]] bool has_scene() const { return file_.has("/scene"); }
  /// The effective scene of the run.
  [[nodiscard]] std::string scene() const { return file_.text("/scene"); }
  /// How many vesicles the run has.
  [[nodiscard]] std::size_t n_vesicles() const { return n_vesicles_; }
  /// @param who  cannot do with several vesicles, "vehd mesh" @throws InputError if there are
  void require_one_vesicle(const std::string& who) const;
  /// Whether a snapshot has the coefficients of this field, of the first vesicle where there are several.
  [[nodiscard]] bool has_field(std::size_t snapshot, const std::string& name) const;
  /// Where the numbers themselves are judged. @throws InputError if the snapshot has no checksum
  void require_sealed(std::size_t snapshot) const;
  /// Harmonic coefficients, [n_coefficients x components], of a snapshot that is intact as a whole. A run.h5 without
  /// checksums is of an earlier program and is read as it is.
  [[nodiscard]] Matrix coefficients(std::size_t snapshot, const std::string& name) const {
    return read(snapshot, name, 0);
  }
  /// See solved_degree().
  [[nodiscard]] int degree(std::size_t snapshot, std::size_t vesicle = 0) const {
    return solved_degree(file_, vesicle_group_of(snapshot, vesicle));
  }
  /// The same, of the stated number of components and of the order of x.
  /// @param vesicle  of several
  [[nodiscard]] Matrix coefficients(std::size_t snapshot, const std::string& name, Index components,
                                    std::size_t vesicle = 0) const;

 private:
  [[nodiscard]] std::string group_of(std::size_t snapshot) const { return "/snapshots/" + names_.at(snapshot); }
  [[nodiscard]] Matrix read(std::size_t snapshot, const std::string& name, std::size_t vesicle) const;
  [[nodiscard]] std::string vesicle_group_of(std::size_t snapshot, std::size_t vesicle) const;
  [[nodiscard]] std::string path_of(std::size_t snapshot, const std::string& name, std::size_t vesicle) const;

  Hdf5Reader file_;
  std::vector<std::string> names_;
  std::vector<double> times_;
  std::size_t n_vesicles_ = 1;
};

}  // namespace vehd

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bie/files/hdf5_handle.hpp"
#include "bie/files/seal.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Reads an HDF5 file that may be damaged or hostile: sizes are checked against those of the stored data before memory
/// is allocated.
/// @throws InputError "file: what is wrong" from every member
class Hdf5Reader {
 public:
  /// Opens a file for reading.
  explicit Hdf5Reader(const std::filesystem::path& path);
  /// A file in memory; `name` stands for it in messages.
  Hdf5Reader(const std::string& image, std::string name);

  /// Whether there is an object of this path.
  [[nodiscard]] bool has(const std::string& object) const;
  /// Names of a group's members in ascending order.
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const;
  /// Dataset of up to 2²¹ numbers of any rank as [last dimensions x first dimension], i.e. [n_points x 3] from [3,
  /// n_theta, n_phi]; rank 1 gives one column.
  [[nodiscard]] Matrix matrix(const std::string& dataset) const;
  /// All values of a dataset in the file's order, [number of values].
  [[nodiscard]] Vector vector(const std::string& dataset) const;
  /// A dataset of one string.
  [[nodiscard]] std::string text(const std::string& dataset) const;
  /// Whether the object has an attribute of this name.
  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
  /// Value of an attribute that is one number.
  [[nodiscard]] double number_attribute(const std::string& object, const std::string& name) const;
  /// Value of an attribute that is one integer.
  [[nodiscard]] std::int64_t integer_attribute(const std::string& object, const std::string& name) const;
  /// Value of an attribute that is one text.
  [[nodiscard]] std::string text_attribute(const std::string& object, const std::string& name) const;

  /// Whether a dataset contains double-precision numbers.
  [[nodiscard]] bool holds_numbers(const std::string& dataset) const;
  /// Checksum of shape, type and values of a dataset, see seal.hpp.
  [[nodiscard]] std::uint32_t dataset_checksum(const std::string& dataset) const;
  /// Checksums of all objects from a group down, except its seal.
  /// @param closed  a group below it whose members are left out
  [[nodiscard]] ObjectChecksums object_checksums(const std::string& group, const std::string& closed = {}) const;

  /// Name of the file in messages.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Throws InputError "name: problem".
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  struct OpenDataset {
    Hdf5Handle handle, type;
    std::vector<hsize_t> extents;
    hsize_t n_values = 1;
  };
  [[nodiscard]] OpenDataset open_dataset(const std::string& dataset) const;
  [[nodiscard]] OpenDataset open_numbers(const std::string& dataset) const;
  void add_checksums(const std::string& object, const std::string& closed, int depth, ObjectChecksums& sums) const;
  void require_open();
  void read_attribute(const std::string& object, const std::string& name, hid_t type, void* value) const;

  std::string name_;
  Hdf5Handle file_;
  hsize_t bytes_ = 0;
};

}  // namespace vehd

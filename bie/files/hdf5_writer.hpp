#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bie/files/hdf5_handle.hpp"
#include "bie/files/seal.hpp"

namespace vehd {

/// Description of a dataset, for readers without this program.
struct DatasetLabel {
  std::string dimension;  ///< "force/area"; "1" if dimensionless
  std::string description;
  std::string unit = "1";  ///< unit of the numbers times the scale
  double scale = 1.0;
};

/// Writes one HDF5 file. Modification times are left out, so that equal data make equal files.
/// @throws OutputError from every member
class Hdf5Writer {
 public:
  /// `read` opens the source of copies, which is never changed. `in_memory` writes no file: the path only names it in
  /// messages.
  enum class Mode { create, in_memory, extend, read };
  /// @param path  path of the file, or its name in messages
  Hdf5Writer(const std::filesystem::path& path, Mode mode);

  /// Makes a group; its parents must exist.
  void group(const std::string& path);
  [[nodiscard]] bool has(const std::string& path) const;
  /// Writes a dataset of numbers.
  /// @param extents  of each dimension, the slowest first; their product is the number of values
  void numbers(const std::string& path, std::span<const double> values, const std::vector<hsize_t>& extents,
               const DatasetLabel& label);
  /// Writes a dataset of integers; extents as of numbers().
  void integers(const std::string& path, std::span<const std::int64_t> values, const std::vector<hsize_t>& extents,
                const DatasetLabel& label);
  /// Writes a dataset of one string.
  void text(const std::string& path, const std::string& value);
  /// Copies an object with everything below it.
  void copy_from(const Hdf5Writer& source, const std::string& path);

  /// Writes an attribute of an existing object.
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  void attribute(const std::string& object, const std::string& name, const std::string& value);

  /// Writes the seal of a group, or of the header of the file ("/"): it covers everything that was written, not copied,
  /// since the last seal.
  /// @return the checksum of the seal
  std::int64_t seal(const std::string& group);

  /// All bytes of the file so far.
  [[nodiscard]] std::string image() const;

  /// Names of a group's members in ascending order.
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const;

  /// Must be called: the destructor would lose the error of a full disk.
  void close();

 private:
  void create(hid_t creation, hid_t access);
  void open(hid_t access, Mode mode);
  [[noreturn]] void fail(const std::string& what) const;
  void write_dataset(const std::string& path, hid_t memory_type, hid_t file_type, std::string_view values,
                     const std::vector<hsize_t>& extents, const DatasetLabel& label);
  void write_attribute(const std::string& object, const std::string& name, hid_t type, const void* value);
  void write_text(const std::string& path, const std::string& value);
  void count_attribute(const std::string& object, std::string_view name, ContentKind kind, std::string_view bytes);

  std::string name_;
  bool deflates_;
  Hdf5Handle dataset_properties_, group_properties_;
  Hdf5Handle file_;
  ObjectChecksums unsealed_;  ///< objects written since the last seal
};

}  // namespace vehd

#include "bie/files/hdf5_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Far more than any dataset or text of this program has; files that claim more would only exhaust the memory.
constexpr hsize_t most_values = hsize_t{1} << 21;
constexpr std::size_t longest_text = std::size_t{1} << 24;
/// Largest compression ratio of deflate.
constexpr hsize_t most_inflation = 1032;
/// More objects and deeper groups than any file of this program has; links back to a group above would not end.
constexpr std::size_t most_objects = std::size_t{1} << 16;
constexpr int deepest_group = 8;

bool is_kind(hid_t type, H5T_class_t kind, std::size_t bytes) {
  return H5Tget_class(type) == kind && H5Tget_size(type) == bytes;
}

/// Whether a dataset is one chunk, shuffled and deflated.
bool is_deflated(hid_t properties, const std::vector<hsize_t>& extents) {
  if (H5Pget_layout(properties) != H5D_CHUNKED) return false;
  std::vector<hsize_t> chunk(extents.size());
  if (H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data()) != std::ssize(chunk)) return false;
  const auto filter = [&](unsigned i) {
    std::size_t n_parameters = 0;
    return H5Pget_filter2(properties, i, nullptr, &n_parameters, nullptr, 0, nullptr, nullptr);
  };
  return chunk == extents && H5Pget_nfilters(properties) == 2 && filter(0) == H5Z_FILTER_SHUFFLE &&
         filter(1) == H5Z_FILTER_DEFLATE;
}

herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// Checksum of one attribute; for a kind that this program does not write, of its name and kind only.
std::uint32_t checksum_of_attribute(hid_t object, const std::string& name) {
  const Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(attribute.valid() ? H5Aget_type(attribute.id()) : H5I_INVALID_HID, H5Tclose);
  const Hdf5Handle space(attribute.valid() ? H5Aget_space(attribute.id()) : H5I_INVALID_HID, H5Sclose);
  const bool is_one = type.valid() && space.valid() && H5Sget_simple_extent_npoints(space.id()) == 1;
  const auto read = [&](ContentKind kind, hid_t memory_type, std::size_t bytes) {
    std::string value(bytes, '\0');
    if (H5Aread(attribute.id(), memory_type, value.data()) < 0) kind = ContentKind::other;
    if (kind == ContentKind::text) value.resize(std::min(value.size(), value.find('\0')));
    return attribute_checksum(name, kind, value);
  };
  if (is_one && is_kind(type.id(), H5T_FLOAT, sizeof(double))) {
    return read(ContentKind::numbers, H5T_NATIVE_DOUBLE, sizeof(double));
  }
  if (is_one && is_kind(type.id(), H5T_INTEGER, sizeof(std::int64_t))) {
    return read(ContentKind::integers, H5T_NATIVE_INT64, sizeof(std::int64_t));
  }
  if (is_one && H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) <= 0 &&
      H5Tget_size(type.id()) <= longest_text) {
    return read(ContentKind::text, type.id(), H5Tget_size(type.id()));
  }
  return attribute_checksum(name, ContentKind::other, {});
}

std::uint32_t checksum_of_attributes(hid_t object) {
  std::vector<std::string> names;
  std::uint32_t sum = 0;
  if (H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &names) < 0) {
    return attribute_checksum("", ContentKind::other, {});
  }
  for (const std::string& name : names) sum += checksum_of_attribute(object, name);
  return sum;
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : name_(path.string()) {
  silence_hdf5();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse("no such file");
  file_ = Hdf5Handle(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  require_open();
}

Hdf5Reader::Hdf5Reader(const std::string& image, std::string name) : name_(std::move(name)) {
  silence_hdf5();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id(), 1 << 16, false);
  // The library copies the image, although its parameter is not const.
  H5Pset_file_image(access.id(), const_cast<char*>(image.data()), image.size());
  // The library looks for a file of that name, which must not exist.
  file_ = Hdf5Handle(H5Fopen((name_ + "/image").c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  require_open();
}

void Hdf5Reader::require_open() {
  if (!file_.valid()) {
    const std::string detail = last_hdf5_error();
    refuse(fmt::format("not a readable HDF5 file: truncated, damaged or of another kind ({})", detail));
  }
  H5Fget_filesize(file_.id(), &bytes_);
}

void Hdf5Reader::refuse(const std::string& problem) const { throw InputError(fmt::format("{}: {}", name_, problem)); }

bool Hdf5Reader::has(const std::string& object) const {
  // H5Lexists requires that every group on the way exists.
  for (std::size_t slash = object.find('/', 1);; slash = object.find('/', slash + 1)) {
    if (H5Lexists(file_.id(), object.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5Reader::members(const std::string& group) const {
  auto names = hdf5_members(file_.id(), group);
  if (!names) refuse(fmt::format("group {} is missing or damaged", group));
  return std::move(*names);
}

Hdf5Reader::OpenDataset Hdf5Reader::open_dataset(const std::string& dataset) const {
  OpenDataset result{Hdf5Handle(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose), {}, {}, 1};
  if (!result.handle.valid()) refuse(fmt::format("dataset {} is missing or damaged", dataset));
  result.type = Hdf5Handle(H5Dget_type(result.handle.id()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(result.handle.id()), H5Sclose);
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space.id()) : -1;
  if (!result.type.valid() || rank < 1 || rank > 4) refuse(fmt::format("dataset {} has an unknown layout", dataset));
  const std::size_t value_bytes = H5Tget_size(result.type.id());
  result.extents.resize(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.id(), result.extents.data(), nullptr);
  const Hdf5Handle properties(H5Dget_create_plist(result.handle.id()), H5Pclose);
  const bool deflated = properties.valid() && is_deflated(properties.id(), result.extents);
  if (!properties.valid() || (!deflated && H5Pget_layout(properties.id()) == H5D_CHUNKED)) {
    refuse(fmt::format("dataset {} has an unknown layout", dataset));
  }
  // A damaged layout can claim more than the file has.
  const hsize_t bytes = std::min<hsize_t>(H5Dget_storage_size(result.handle.id()), bytes_);
  const hsize_t stored = value_bytes == 0 ? 0 : bytes / value_bytes * (deflated ? most_inflation : 1);
  for (const hsize_t extent : result.extents) {
    // Checked before each product so that it cannot overflow.
    if (extent == 0 || result.n_values > stored / extent) {
      refuse(fmt::format("dataset {} claims more numbers than the file stores", dataset));
    }
    result.n_values *= extent;
  }
  if (result.n_values > most_values) {
    refuse(fmt::format("dataset {} has {} numbers; accepted: at most {}", dataset, result.n_values, most_values));
  }
  return result;
}

Hdf5Reader::OpenDataset Hdf5Reader::open_numbers(const std::string& dataset) const {
  OpenDataset result = open_dataset(dataset);
  if (!is_kind(result.type.id(), H5T_FLOAT, sizeof(double))) {
    refuse(fmt::format("dataset {} does not contain double-precision numbers", dataset));
  }
  return result;
}

Matrix Hdf5Reader::matrix(const std::string& dataset) const {
  const OpenDataset open = open_numbers(dataset);
  const Index n_columns = open.extents.size() == 1 ? 1 : static_cast<Index>(open.extents.front());
  Matrix values(static_cast<Index>(open.n_values) / n_columns, n_columns);
  if (H5Dread(open.handle.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    refuse(fmt::format("dataset {} cannot be read", dataset));
  }
  return values;
}

Vector Hdf5Reader::vector(const std::string& dataset) const { return matrix(dataset).reshaped(); }

std::string Hdf5Reader::text(const std::string& dataset) const {
  const Hdf5Handle handle(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!handle.valid()) refuse(fmt::format("text {} is missing or damaged", dataset));
  const Hdf5Handle type(H5Dget_type(handle.id()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(handle.id()), H5Sclose);
  if (!type.valid() || H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0 ||
      H5Sget_simple_extent_npoints(space.id()) != 1 || H5Dget_storage_size(handle.id()) < H5Tget_size(type.id()) ||
      bytes_ < H5Tget_size(type.id())) {
    refuse(fmt::format("{} is not a text of fixed length", dataset));
  }
  if (H5Tget_size(type.id()) > longest_text) {
    refuse(fmt::format("text {} has {} bytes; accepted: at most {}", dataset, H5Tget_size(type.id()), longest_text));
  }
  std::string value(H5Tget_size(type.id()), '\0');
  const Hdf5Handle memory_type(H5Tcopy(type.id()), H5Tclose);
  if (H5Dread(handle.id(), memory_type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) {
    refuse(fmt::format("text {} cannot be read", dataset));
  }
  value.resize(std::min(value.size(), value.find('\0')));
  return value;
}

bool Hdf5Reader::holds_numbers(const std::string& dataset) const {
  const Hdf5Handle handle(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle type(handle.valid() ? H5Dget_type(handle.id()) : H5I_INVALID_HID, H5Tclose);
  return type.valid() && is_kind(type.id(), H5T_FLOAT, sizeof(double));
}

std::uint32_t Hdf5Reader::dataset_checksum(const std::string& dataset) const {
  {
    const Hdf5Handle handle(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle type(handle.valid() ? H5Dget_type(handle.id()) : H5I_INVALID_HID, H5Tclose);
    if (type.valid() && H5Tget_class(type.id()) == H5T_STRING) {
      return content_checksum(ContentKind::text, {}, text(dataset));
    }
  }
  const OpenDataset open = open_dataset(dataset);
  const bool is_double = is_kind(open.type.id(), H5T_FLOAT, sizeof(double));
  if (!is_double && !is_kind(open.type.id(), H5T_INTEGER, sizeof(std::int64_t))) {
    return content_checksum(ContentKind::other, open.extents, {});
  }
  std::string bytes(open.n_values * sizeof(double), '\0');
  const hid_t memory_type = is_double ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
  if (H5Dread(open.handle.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0) {
    refuse(fmt::format("dataset {} cannot be read", dataset));
  }
  return content_checksum(is_double ? ContentKind::numbers : ContentKind::integers, open.extents, bytes);
}

void Hdf5Reader::add_checksums(const std::string& object, const std::string& closed, int depth,
                               ObjectChecksums& sums) const {
  const Hdf5Handle handle(H5Oopen(file_.id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!handle.valid()) refuse(fmt::format("{} is missing or damaged", object));
  if (sums.size() >= most_objects || depth > deepest_group) refuse("has more objects than any run");
  const bool is_group = H5Iget_type(handle.id()) == H5I_GROUP;
  sums[object] = checksum_of_attributes(handle.id()) +
                 (is_group ? content_checksum(ContentKind::group, {}, {}) : dataset_checksum(object));
  if (!is_group || object == closed) return;
  for (const std::string& name : members(object)) {
    add_checksums(object == "/" ? "/" + name : object + "/" + name, closed, depth + 1, sums);
  }
}

ObjectChecksums Hdf5Reader::object_checksums(const std::string& group, const std::string& closed) const {
  ObjectChecksums sums;
  add_checksums(group, closed, 0, sums);
  sums.erase(seal_path(group));
  return sums;
}

void Hdf5Reader::read_attribute(const std::string& object, const std::string& name, hid_t type, void* value) const {
  const Hdf5Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  const Hdf5Handle space(attribute.valid() ? H5Aget_space(attribute.id()) : H5I_INVALID_HID, H5Sclose);
  if (!space.valid() || H5Sget_simple_extent_npoints(space.id()) != 1 || H5Aread(attribute.id(), type, value) < 0) {
    refuse(fmt::format("attribute {} of {} is missing or damaged", name, object));
  }
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

double Hdf5Reader::number_attribute(const std::string& object, const std::string& name) const {
  double value = 0.0;
  read_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value = 0;
  read_attribute(object, name, H5T_NATIVE_INT64, &value);
  return value;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  const Hdf5Handle type(attribute.valid() ? H5Aget_type(attribute.id()) : H5I_INVALID_HID, H5Tclose);
  if (!type.valid() || H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0 ||
      H5Tget_size(type.id()) > longest_text) {
    refuse(fmt::format("attribute {} of {} is missing or no text of fixed length", name, object));
  }
  std::string value(H5Tget_size(type.id()), '\0');
  read_attribute(object, name, type.id(), value.data());
  value.resize(std::min(value.size(), value.find('\0')));
  return value;
}

}  // namespace vehd

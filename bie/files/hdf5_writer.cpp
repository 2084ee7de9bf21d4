#include "bie/files/hdf5_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

// A snapshot has dozens of small datasets: whole pages save four of five reads and writes.
constexpr hsize_t page_bytes = 1 << 16;
constexpr std::size_t buffered_pages = 16;
/// Increment of a file in memory: it is cleared, and written up to the next multiple.
constexpr std::size_t memory_step = 1 << 14;

Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(length, 1));
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

/// Properties of datasets without modification times, which are not filled before they are written.
Hdf5Handle dataset_properties() {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.id(), false);
  H5Pset_fill_time(properties.id(), H5D_FILL_TIME_NEVER);
  return properties;
}

/// Fields of a symmetric shape compress well. Smaller datasets would be outweighed by the description of the filters.
constexpr std::size_t least_deflated_bytes = 1 << 10;
constexpr unsigned deflate_level = 1;

/// Properties of a dataset of one chunk, shuffled and deflated.
Hdf5Handle deflated(const Hdf5Handle& properties, const std::vector<hsize_t>& extents) {
  Hdf5Handle result(H5Pcopy(properties.id()), H5Pclose);
  H5Pset_chunk(result.id(), static_cast<int>(extents.size()), extents.data());
  H5Pset_shuffle(result.id());
  H5Pset_deflate(result.id(), deflate_level);
  return result;
}

/// Groups of a snapshot have about a dozen members, which cost least as a plain list.
Hdf5Handle group_properties() {
  constexpr unsigned most_in_list = 24;
  Hdf5Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_link_phase_change(properties.id(), most_in_list, most_in_list / 2);
  return properties;
}

template <typename Number>
std::string_view bytes_of(std::span<const Number> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

template <typename Number>
std::string_view bytes_of(const Number& value) {
  return bytes_of(std::span<const Number>(&value, 1));
}

bool put_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  Hdf5Handle handle(H5Acreate2(object, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return handle.valid() && H5Awrite(handle.id(), type, value) >= 0 && handle.close();
}

bool put_attribute(hid_t object, const std::string& name, const std::string& value) {
  return put_attribute(object, name, text_type(value.size()).id(), value.c_str());
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path, Mode mode)
    : name_(path.string()),
      deflates_(mode != Mode::in_memory),
      dataset_properties_(dataset_properties()),
      group_properties_(group_properties()) {
  silence_hdf5();
  errno = 0;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V110);
  if (mode == Mode::in_memory) {
    // In later formats the library changes a byte in the image that it returns, but not the checksum over it.
    H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V110);
    H5Pset_fapl_core(access.id(), memory_step, false);
    create(H5P_DEFAULT, access.id());
  } else if (mode == Mode::create) {
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_file_space_strategy(creation.id(), H5F_FSPACE_STRATEGY_PAGE, false, 1);
    H5Pset_file_space_page_size(creation.id(), page_bytes);
    // Every dataset is one chunk.
    H5Pset_istore_k(creation.id(), 1);
    create(creation.id(), access.id());
  } else {
    open(access.id(), mode);
  }
}

void Hdf5Writer::create(hid_t creation, hid_t access) {
  file_ = Hdf5Handle(H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  // Checked here, as any further call would discard the reason.
  if (!file_.valid()) fail("cannot be opened");
  unsealed_["/"] = content_checksum(ContentKind::group, {}, {});
}

void Hdf5Writer::open(hid_t access, Mode mode) {
  const bool extends = mode == Mode::extend;
  const auto opens_with = [&](std::size_t buffer) {
    H5Pset_page_buffer_size(access, buffer, 0, 0);
    file_ = Hdf5Handle(H5Fopen(name_.c_str(), extends ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access), H5Fclose);
    return file_.valid();
  };
  // In a file to be extended only the groups at its beginning are read. Headers elsewhere must not be: HDF5 1.10
  // guesses their size and reads beyond a buffered page if one lies at its end.
  if (extends && opens_with(buffered_pages * page_bytes)) return;
  // The library refuses a page buffer for a file that was not made in pages.
  if (!opens_with(0)) fail("cannot be opened");
}

void Hdf5Writer::fail(const std::string& what) const {
  throw OutputError(fmt::format("{}: {} ({})", name_, what, last_hdf5_error()));
}

bool Hdf5Writer::has(const std::string& path) const { return H5Lexists(file_.id(), path.c_str(), H5P_DEFAULT) > 0; }

void Hdf5Writer::group(const std::string& path) {
  const Hdf5Handle handle(H5Gcreate2(file_.id(), path.c_str(), H5P_DEFAULT, group_properties_.id(), H5P_DEFAULT),
                          H5Gclose);
  if (!handle.valid()) fail(fmt::format("group {} cannot be written", path));
  unsealed_[path] += content_checksum(ContentKind::group, {}, {});
}

void Hdf5Writer::numbers(const std::string& path, std::span<const double> values, const std::vector<hsize_t>& extents,
                         const DatasetLabel& label) {
  write_dataset(path, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, bytes_of(values), extents, label);
  unsealed_[path] += content_checksum(ContentKind::numbers, extents, bytes_of(values));
}

void Hdf5Writer::integers(const std::string& path, std::span<const std::int64_t> values,
                          const std::vector<hsize_t>& extents, const DatasetLabel& label) {
  write_dataset(path, H5T_NATIVE_INT64, H5T_STD_I64LE, bytes_of(values), extents, label);
  unsealed_[path] += content_checksum(ContentKind::integers, extents, bytes_of(values));
}

void Hdf5Writer::write_dataset(const std::string& path, hid_t memory_type, hid_t file_type, std::string_view values,
                               const std::vector<hsize_t>& extents, const DatasetLabel& label) {
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
  const bool deflates = deflates_ && values.size() >= least_deflated_bytes;
  const Hdf5Handle chunked = deflates ? deflated(dataset_properties_, extents) : Hdf5Handle();
  Hdf5Handle dataset(H5Dcreate2(file_.id(), path.c_str(), file_type, space.id(), H5P_DEFAULT,
                                (deflates ? chunked : dataset_properties_).id(), H5P_DEFAULT),
                     H5Dclose);
  if (!dataset.valid() || H5Dwrite(dataset.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0 ||
      !put_attribute(dataset.id(), "dimension", label.dimension) || !put_attribute(dataset.id(), "unit", label.unit) ||
      !put_attribute(dataset.id(), "scale", H5T_NATIVE_DOUBLE, &label.scale) ||
      !put_attribute(dataset.id(), "description", label.description) || !dataset.close()) {
    fail(fmt::format("dataset {} cannot be written", path));
  }
  count_attribute(path, "dimension", ContentKind::text, label.dimension);
  count_attribute(path, "unit", ContentKind::text, label.unit);
  count_attribute(path, "scale", ContentKind::numbers, bytes_of(label.scale));
  count_attribute(path, "description", ContentKind::text, label.description);
}

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  write_text(path, value);
  unsealed_[path] += content_checksum(ContentKind::text, {}, value);
}

std::int64_t Hdf5Writer::seal(const std::string& group) {
  const std::string text = seal_text(std::exchange(unsealed_, {}));
  write_text(seal_path(group), text);
  return seal_checksum(text);
}

void Hdf5Writer::write_text(const std::string& path, const std::string& value) {
  const Hdf5Handle type = text_type(value.size());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle dataset(
      H5Dcreate2(file_.id(), path.c_str(), type.id(), space.id(), H5P_DEFAULT, dataset_properties_.id(), H5P_DEFAULT),
      H5Dclose);
  if (!dataset.valid() || H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str()) < 0) {
    fail(fmt::format("text {} cannot be written", path));
  }
}

void Hdf5Writer::copy_from(const Hdf5Writer& source, const std::string& path) {
  if (H5Ocopy(source.file_.id(), path.c_str(), file_.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0) {
    fail(fmt::format("{} cannot be copied from {}", path, source.name_));
  }
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, double value) {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
  count_attribute(object, name, ContentKind::numbers, bytes_of(value));
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  write_attribute(object, name, H5T_NATIVE_INT64, &value);
  count_attribute(object, name, ContentKind::integers, bytes_of(value));
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, const std::string& value) {
  write_attribute(object, name, text_type(value.size()).id(), value.c_str());
  count_attribute(object, name, ContentKind::text, value);
}

void Hdf5Writer::count_attribute(const std::string& object, std::string_view name, ContentKind kind,
                                 std::string_view bytes) {
  unsealed_[object] += attribute_checksum(name, kind, bytes);
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name, hid_t type, const void* value) {
  const Hdf5Handle handle(H5Oopen(file_.id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!handle.valid() || !put_attribute(handle.id(), name, type, value)) {
    fail(fmt::format("attribute {} of {} cannot be written", name, object));
  }
}

std::vector<std::string> Hdf5Writer::members(const std::string& group_path) const {
  auto names = hdf5_members(file_.id(), group_path);
  if (!names) fail(fmt::format("group {} cannot be read", group_path));
  return std::move(*names);
}

std::string Hdf5Writer::image() const {
  if (H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) < 0) fail("cannot be completed");
  const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
  std::string bytes(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  if (size <= 0 || H5Fget_file_image(file_.id(), bytes.data(), bytes.size()) != size) fail("cannot be completed");
  return bytes;
}

void Hdf5Writer::close() {
  if (H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) < 0 || !file_.close()) fail("cannot be written completely");
}

}  // namespace vehd

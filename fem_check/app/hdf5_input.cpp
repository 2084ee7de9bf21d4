#include "fem_check/app/hdf5_input.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <vector>

namespace vehd::fem_check {
namespace {

/// Closes an identifier with the function for its type.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] hid_t id() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

constexpr int largest_rank = 2;
/// Maximum compression ratio of deflate.
constexpr hsize_t most_inflation = 1032;

}  // namespace

Hdf5Input::Hdf5Input(const std::filesystem::path& path) : name_(path.string()) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse("no such file");
  file_ = H5Fopen(name_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) refuse("no readable HDF5 file, it is truncated, damaged or of another kind");
}

Hdf5Input::~Hdf5Input() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Input::refuse(const std::string& problem) const { throw InputError(fmt::format("{}: {}", name_, problem)); }

bool Hdf5Input::has(const std::string& object) const {
  // H5Lexists requires all parent groups to exist.
  for (std::size_t slash = object.find('/', 1);; slash = object.find('/', slash + 1)) {
    if (H5Lexists(file_, object.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

Eigen::MatrixXd Hdf5Input::matrix(const std::string& dataset) const {
  const Handle handle(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!handle.valid()) refuse(fmt::format("dataset {} is missing or damaged", dataset));
  const Handle space(H5Dget_space(handle.id()), H5Sclose);
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space.id()) : -1;
  if (rank < 1 || rank > largest_rank) refuse(fmt::format("dataset {} has an unknown layout", dataset));
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.id(), extents.data(), nullptr);
  const hsize_t stored = most_inflation * (H5Dget_storage_size(handle.id()) / sizeof(double));
  const hsize_t components = rank == 1 ? 1 : extents.front();
  // Compared by division, since a product could overflow.
  if (components == 0 || extents.back() == 0 || stored / components < extents.back()) {
    refuse(fmt::format("dataset {} stores at most {} numbers, less than its size says", dataset, stored));
  }
  Eigen::MatrixXd values(static_cast<Eigen::Index>(extents.back()), static_cast<Eigen::Index>(components));
  if (H5Dread(handle.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    refuse(fmt::format("dataset {} cannot be read", dataset));
  }
  if (!values.allFinite()) refuse(fmt::format("dataset {} holds values that are not finite", dataset));
  return values;
}

bool Hdf5Input::has_attribute(const std::string& object, const std::string& attribute) const {
  return H5Aexists_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT) > 0;
}

double Hdf5Input::number(const std::string& object, const std::string& attribute) const {
  const Handle handle(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  double value = 0.0;
  if (!handle.valid() || H5Aread(handle.id(), H5T_NATIVE_DOUBLE, &value) < 0) {
    refuse(fmt::format("attribute {} of {} is missing or damaged", attribute, object));
  }
  return value;
}

std::string Hdf5Input::text(const std::string& object, const std::string& attribute) const {
  const Handle handle(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle type(handle.valid() ? H5Aget_type(handle.id()) : H5I_INVALID_HID, H5Tclose);
  if (!type.valid() || H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0) {
    refuse(fmt::format("attribute {} of {} is no text of fixed length", attribute, object));
  }
  std::string value(H5Tget_size(type.id()), '\0');
  if (H5Aread(handle.id(), type.id(), value.data()) < 0) {
    refuse(fmt::format("attribute {} of {} cannot be read", attribute, object));
  }
  value.resize(std::min(value.size(), value.find('\0')));
  return value;
}

}  // namespace vehd::fem_check

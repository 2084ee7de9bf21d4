#pragma once

#include <hdf5.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bie/files/hdf5_handle.hpp"
#include "bie/files/run_reader.hpp"

/// Changes of a run.h5 that its checksums do not show.
namespace vehd::testing {

inline Hdf5Handle open_for_damage(const std::string& path) {
  silence_hdf5();
  Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  if (!file.valid()) throw std::runtime_error(path + " cannot be opened");
  return file;
}

/// Every number of a dataset becomes change(number).
inline void change_dataset(hid_t file, const std::string& dataset, const std::function<double(double)>& change) {
  const Hdf5Handle data(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(data.id()), H5Sclose);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id())));
  const bool read = H5Dread(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
  for (double& value : values) value = change(value);
  if (!read || H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    throw std::runtime_error(dataset + " cannot be changed");
  }
}

/// As a program would have written it that computes the field wrongly: with the checksum of what is there now.
/// @param group  of the snapshot
inline void reseal(const std::string& path, const std::string& group) {
  const std::int64_t checksum = snapshot_checksum(Hdf5Reader(path), group);
  const Hdf5Handle file = open_for_damage(path);
  // HDF5 1.10 does not write an attribute of a group of these files a second time.
  const bool removed = H5Adelete_by_name(file.id(), group.c_str(), "checksum", H5P_DEFAULT) >= 0;
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate_by_name(file.id(), group.c_str(), "checksum", H5T_NATIVE_INT64, space.id(),
                                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  if (!removed || H5Awrite(attribute.id(), H5T_NATIVE_INT64, &checksum) < 0) {
    throw std::runtime_error(path + " cannot be sealed");
  }
}

}  // namespace vehd::testing

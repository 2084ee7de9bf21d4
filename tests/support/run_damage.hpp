#pragma once

#include <hdf5.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bie/files/hdf5_handle.hpp"
#include "tests/support/seals.hpp"

/// Changes of a run.h5 that its checksums do not reveal.
namespace vehd::testing {

inline Hdf5Handle open_for_damage(const std::string& path) {
  silence_hdf5();
  Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  if (!file.valid()) throw std::runtime_error(path + " cannot be opened");
  return file;
}

/// Replaces every number of a dataset by change(number).
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

}  // namespace vehd::testing

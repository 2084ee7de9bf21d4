#pragma once

#include <hdf5.h>

#include <string>

#include "bie/files/hdf5_handle.hpp"
#include "bie/files/hdf5_reader.hpp"

namespace vehd::testing {

/// Replaces the object at a path by a text.
inline void put_text(hid_t file, const std::string& path, const std::string& text) {
  H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), text.size() + 1);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle dataset(H5Dcreate2(file, path.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose);
  H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str());
}

/// Seal that matches the present content of a part of a file.
inline std::string seal_of(const Hdf5Reader& file, const std::string& group) {
  return seal_text(file.object_checksums(group, group == "/" ? "/snapshots" : ""));
}

/// Seals the present content of a part of a file, as a program that computes wrongly would.
inline void reseal(const std::string& path, const std::string& group) {
  const std::string seal = seal_of(Hdf5Reader(std::filesystem::path(path)), group);
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  put_text(file.id(), seal_path(group), seal);
}

}  // namespace vehd::testing

#pragma once

#include <hdf5.h>

#include <string>

#include "bie/files/hdf5_handle.hpp"
#include "bie/files/hdf5_reader.hpp"

namespace vehd::testing {

/// Writes a text in place of whatever has its path.
inline void put_text(hid_t file, const std::string& path, const std::string& text) {
  H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), text.size() + 1);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle dataset(H5Dcreate2(file, path.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose);
  H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str());
}

/// The seal that a part of a file would have if a program had written it as it is.
inline std::string seal_of(const Hdf5Reader& file, const std::string& group) {
  return seal_text(file.object_checksums(group, group == "/" ? "/snapshots" : ""));
}

/// Seals a part of a file as it is: as a program would have written it that computes wrongly.
inline void reseal(const std::string& path, const std::string& group) {
  const std::string seal = seal_of(Hdf5Reader(std::filesystem::path(path)), group);
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  put_text(file.id(), seal_path(group), seal);
}

}  // namespace vehd::testing

#include "bie/files/hdf5_handle.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace vehd {
namespace {

herr_t keep_description(unsigned, const H5E_error2_t* error, void* data) {
  if (error->desc != nullptr) *static_cast<std::string*>(data) = error->desc;
  return 0;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* data) {
  static_cast<std::vector<std::string>*>(data)->emplace_back(name);
  return 0;
}

}  // namespace

std::string last_hdf5_error() {
  std::string description;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_description, &description);
  // For a failed system call, only the reason: time, descriptor and addresses would fill several lines.
  const std::string mark = "error message = '";
  if (const std::size_t start = description.find(mark); start != std::string::npos) {
    description = description.substr(start + mark.size());
    description.erase(std::min(description.find('\''), description.size()));
  }
  std::replace(description.begin(), description.end(), '\n', ' ');
  if (!description.empty()) return description;
  // The library keeps no message if a call fails before it has begun to read or write.
  return errno != 0 ? std::strerror(errno) : "no details";
}

std::optional<std::vector<std::string>> hdf5_members(hid_t file, const std::string& group) {
  std::vector<std::string> names;
  const Hdf5Handle handle(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!handle.valid() || H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names) < 0) {
    return std::nullopt;
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace vehd

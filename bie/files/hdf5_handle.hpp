#pragma once

#include <hdf5.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vehd {

/// Owns one HDF5 identifier and closes it with the function that belongs to its kind.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close_function) : id_(id), close_(close_function) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, H5I_INVALID_HID);
      close_ = other.close_;
    }
    return *this;
  }

  [[nodiscard]] hid_t id() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }
  /// Closes now; false if that failed, which for a file means that data may be missing.
  bool close() { return id_ < 0 || close_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }

 private:
  void reset() { close(); }

  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Disables printing of the library's error stack, as every failure becomes an exception of the caller, and closing of
/// open files when the program ends: a file that a full disk kept from being closed would crash it.
inline void silence_hdf5() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// Deepest message of the library's error stack, for the end of an error line.
std::string last_hdf5_error();

/// Names of the members of a group in ascending order; nothing if the group cannot be read.
std::optional<std::vector<std::string>> hdf5_members(hid_t file, const std::string& group);

}  // namespace vehd

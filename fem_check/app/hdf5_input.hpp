#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace vehd::fem_check {

/// An unusable file or option; the message names it.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the HDF5 file of the boundary-integral side. @throws InputError from every member
class Hdf5Input {
 public:
  explicit Hdf5Input(const std::filesystem::path& path);
  ~Hdf5Input();
  Hdf5Input(const Hdf5Input&) = delete;
  Hdf5Input& operator=(const Hdf5Input&) = delete;

  [[nodiscard]] bool has(const std::string& object) const;
  /// Dataset [components, n] as [n x components]; a dataset [n] gives one column.
  [[nodiscard]] Eigen::MatrixXd matrix(const std::string& dataset) const;
  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& attribute) const;
  [[nodiscard]] double number(const std::string& object, const std::string& attribute) const;
  [[nodiscard]] std::string text(const std::string& object, const std::string& attribute) const;

  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  std::string name_;
  long file_ = -1;
};

}  // namespace vehd::fem_check

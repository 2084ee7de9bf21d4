#pragma once

#include <filesystem>
#include <string>

namespace vehd {

/// Where a command leaves the result that a program reads: a file, a pipe, or standard output, which "-" stands for.
/// From construction on, output of the command goes to standard error if the result goes to standard output.
class ResultFile {
 public:
  /// @throws OutputError if standard output cannot be kept for the result
  explicit ResultFile(std::filesystem::path path);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// As `replace_file`.
  /// @throws OutputError
  void write(const std::string& text) const;

 private:
  std::filesystem::path path_;
  int standard_output_ = -1;  ///< -1: the result goes elsewhere
};

}  // namespace vehd

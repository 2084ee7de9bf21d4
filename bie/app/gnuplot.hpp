#pragma once

#include <filesystem>
#include <string>

namespace vehd {

/// Runs gnuplot on a script in the given folder, where relative file names of the script start.
/// @throws InputError if gnuplot is missing or reports an error
void run_gnuplot(const std::string& script, const std::filesystem::path& folder);

/// A file name as a gnuplot string.
std::string gnuplot_quoted(const std::string& text);

/// File that is deleted at the end of its scope.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace vehd

#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// File operations whose outcome survives a kill at any instant.
namespace vehd {

/// A file could not be written: no permission, disk full, directory gone. Exit code 1.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Path of the hidden link that `exchange_by_renames` may leave behind.
std::filesystem::path link_of(const std::filesystem::path& path);

/// Path of the temporary file beside `path` that a replacement is written to first.
std::filesystem::path temporary_of(const std::filesystem::path& path);

/// The target at the end of a path's links.
struct LinkEnd {
  std::filesystem::path path;     ///< no link itself; there need not be a file
  std::optional<int> descriptor;  ///< of this program, where the path is /dev/stdout, /dev/fd/3 or the like
};

/// Follows links, also where the last one leads to no file.
/// @throws OutputError if they go in a circle
LinkEnd end_of_links(const std::filesystem::path& path);

/// Writes the text to where the path leads, links followed. A regular file, or one that is not there yet, is replaced
/// in one step: a reader sees the old or the new text, never a part. Into anything else (pipe, terminal, device) the
/// text is written; a pipe waits for its reader.
/// @throws OutputError
void replace_file(const std::filesystem::path& path, const std::string& text);

/// Replaces a file in one step, also where processes of several machines do so at once.
/// @throws OutputError
void replace_shared_file(const std::filesystem::path& path, const std::string& text);

/// A hidden name beside `path` that no other call gives, of whatever process and machine.
std::filesystem::path unique_name_beside(const std::filesystem::path& path);

/// Creates a folder with its parents; one that is there already is as good.
/// @throws OutputError
void make_directory(const std::filesystem::path& directory);

/// Files of a folder whose names end like that (".toml"), in the order of their names; none if it cannot be read.
std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder, const std::string& extension);

/// Content of a file; empty if it cannot be read.
std::string text_of_file(const std::filesystem::path& path);

/// Writes all of the text.
/// @throws OutputError that names the path
void write_to_descriptor(int descriptor, const std::string& text, const std::filesystem::path& name);

/// rename(2).
/// @throws OutputError
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Exchanges two names in a folder, in one step where the file system can; elsewhere by
/// `exchange_by_renames`.
/// @throws OutputError
void exchange_files(const std::filesystem::path& path, const std::filesystem::path& other);

/// Exchanges two names in steps between which `path` always names one of the two files; a kill can leave `other`
/// missing and a hidden link to the file that was `path`.
/// @throws OutputError
void exchange_by_renames(const std::filesystem::path& path, const std::filesystem::path& other);

/// Waits until the file's data are on the disk.
/// @throws OutputError
void synchronise_file(const std::filesystem::path& path);

/// "path: cannot be written: reason" with the reason of errno.
std::string write_problem(const std::filesystem::path& path);

/// A folder among the temporary files of the machine that ends with its owner.
/// @throws OutputError
class TemporaryFolder {
 public:
  /// @param stem  beginning of its name
  explicit TemporaryFolder(const std::string& stem);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

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

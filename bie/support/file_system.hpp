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

/// Target at the end of a chain of symbolic links.
struct LinkEnd {
  std::filesystem::path path;     ///< not a link itself; the file need not exist
  std::optional<int> descriptor;  ///< of this process, if the path is /dev/stdout, /dev/fd/3 or similar
};

/// Follows links, also if the last one leads to a file that does not exist.
/// @throws OutputError after 40 links, as in a cycle
LinkEnd end_of_links(const std::filesystem::path& path);

/// Writes the text to the target of the path, links followed. A regular file, existing or new, is replaced in one step:
/// a reader sees the old or the new text, never a part. To any other target (pipe, terminal, device) the text is
/// written directly; a pipe waits for its reader.
/// @throws OutputError
void replace_file(const std::filesystem::path& path, const std::string& text);

/// Replaces a file in one step, even if processes of several machines do so at the same time.
/// @throws OutputError
void replace_shared_file(const std::filesystem::path& path, const std::string& text);

/// A hidden name beside `path` that differs from call to call, by process and time.
std::filesystem::path unique_name_beside(const std::filesystem::path& path);

/// Creates a folder with its parents; does nothing if it exists.
/// @throws OutputError
void make_directory(const std::filesystem::path& directory);

/// Files of a folder with this extension (".toml"), sorted by name; none if the folder cannot be read.
std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder, const std::string& extension);

/// Content of a file; empty if it cannot be read.
std::string text_of_file(const std::filesystem::path& path);

/// Writes all of the text.
/// @throws OutputError that names the path
void write_to_descriptor(int descriptor, const std::string& text, const std::filesystem::path& name);

/// rename(2).
/// @throws OutputError
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Exchanges two names in a folder, in one step if the file system supports it, otherwise by `exchange_by_renames`.
/// @throws OutputError
void exchange_files(const std::filesystem::path& path, const std::filesystem::path& other);

/// Exchanges two names in steps between which `path` always names one of the two files; a kill can leave `other`
/// missing and a hidden link to the original file of `path`.
/// @throws OutputError
void exchange_by_renames(const std::filesystem::path& path, const std::filesystem::path& other);

/// Waits until the file's data are on the disk.
/// @throws OutputError
void synchronise_file(const std::filesystem::path& path);

/// "path: cannot be written: reason", with the reason from errno.
std::string write_problem(const std::filesystem::path& path);

/// A temporary folder that is deleted with this object.
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

/// A file that is deleted at the end of the scope of this object.
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

/// Destination of a result that another program reads: a file, a pipe, or standard output ("-"). From construction on,
/// other output of the command goes to standard error if the result goes to standard output.
class ResultFile {
 public:
  /// @throws OutputError if standard output cannot be kept for the result
  explicit ResultFile(std::filesystem::path path);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// Writes the text as `replace_file` does.
  /// @throws OutputError
  void write(const std::string& text) const;

 private:
  std::filesystem::path path_;
  int standard_output_ = -1;  ///< -1: the result goes elsewhere
};

}  // namespace vehd

#pragma once

#include <filesystem>
#include <string>

/// File operations whose outcome survives a kill at any instant.
namespace vehd {

/// Path of the hidden link that `exchange_by_renames` may leave behind.
std::filesystem::path link_of(const std::filesystem::path& path);

/// Path of the temporary file beside `path` that a replacement is written to first.
std::filesystem::path temporary_of(const std::filesystem::path& path);

/// Replaces the file in one step: a reader sees the old or the new text, never a part. @throws OutputError
void replace_file(const std::filesystem::path& path, const std::string& text);

/// rename(2). @throws OutputError
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Exchanges what two names of a folder stand for, in one step where the file system can; elsewhere by
/// `exchange_by_renames`. @throws OutputError
void exchange_files(const std::filesystem::path& path, const std::filesystem::path& other);

/// The same in steps between which `path` always stands for one of the two files; a kill can leave `other` missing and
/// a hidden link to the file that was `path`. @throws OutputError
void exchange_by_renames(const std::filesystem::path& path, const std::filesystem::path& other);

/// Waits until the file's data are on the disk. @throws OutputError
void synchronise_file(const std::filesystem::path& path);

/// A folder among the temporary files of the machine that ends with its owner. @throws OutputError
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& stem);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// "path: cannot be written: reason" with the reason of errno.
std::string write_problem(const std::filesystem::path& path);

}  // namespace vehd

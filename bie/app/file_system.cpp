#include "bie/app/file_system.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "bie/app/errors.hpp"

namespace vehd {

std::filesystem::path temporary_of(const std::filesystem::path& path) {
  return path.parent_path() / fmt::format(".{}.new", path.filename().string());
}

std::filesystem::path link_of(const std::filesystem::path& path) {
  return path.parent_path() / fmt::format(".{}.old", path.filename().string());
}

void replace_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path temporary = temporary_of(path);
  {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream << text;
    stream.close();
    if (!stream) {
      const std::string problem = write_problem(path);
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      throw OutputError(problem);
    }
  }
  rename_file(temporary, path);
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) throw OutputError(write_problem(to));
}

void exchange_files(const std::filesystem::path& path, const std::filesystem::path& other) {
  if (::renameat2(AT_FDCWD, other.c_str(), AT_FDCWD, path.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS) throw OutputError(write_problem(path));
  exchange_by_renames(path, other);
}

void exchange_by_renames(const std::filesystem::path& path, const std::filesystem::path& other) {
  const std::filesystem::path link = link_of(path);
  // The link keeps the file reachable while its name moves to the other one; file systems without hard links get a
  // copy.
  std::error_code error;
  std::filesystem::create_hard_link(path, link, error);
  if (error) std::filesystem::copy_file(path, link, std::filesystem::copy_options::overwrite_existing, error);
  if (error) throw OutputError(fmt::format("{}: cannot be written: {}", link.string(), error.message()));
  rename_file(other, path);
  rename_file(link, other);
}

void synchronise_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool written = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (!written) {
    const std::string problem = write_problem(path);
    if (descriptor >= 0) ::close(descriptor);
    throw OutputError(problem);
  }
  ::close(descriptor);
}

std::string write_problem(const std::filesystem::path& path) {
  return fmt::format("{}: cannot be written: {}", path.string(),
                     errno == 0 ? std::string("unknown reason") : std::string(std::strerror(errno)));
}

TemporaryFolder::TemporaryFolder(const std::string& stem) {
  std::string pattern = (std::filesystem::temp_directory_path() / (stem + ".XXXXXX")).string();
  if (::mkdtemp(pattern.data()) == nullptr) throw OutputError(write_problem(pattern));
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace vehd

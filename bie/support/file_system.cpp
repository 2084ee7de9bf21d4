#include "bie/support/file_system.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

namespace vehd {
namespace {

/// The limit of Linux.
constexpr int most_links = 40;

struct DescriptorCloser {
  int descriptor;
  ~DescriptorCloser() { ::close(descriptor); }
};

bool is_link(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_symlink(path, ignored);
}

/// Exists and is not a regular file.
bool is_no_regular_file(const std::filesystem::file_status& status) {
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

/// N of a path /proc/self/fd/N, under any name of that folder. The entry looks like a link, but opening it by name
/// would start a file from its beginning, and fails for a socket.
std::optional<int> descriptor_of(const std::filesystem::path& path) {
  std::error_code problem, self_problem;
  const std::filesystem::path folder = std::filesystem::canonical(path.parent_path(), problem);
  if (problem || folder != std::filesystem::canonical("/proc/self/fd", self_problem) || self_problem) return {};
  const std::string name = path.filename().string();
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size()) return {};
  return number;
}

void replace_regular_file(const std::filesystem::path& path, const std::string& text) {
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

}  // namespace

std::filesystem::path temporary_of(const std::filesystem::path& path) {
  return path.parent_path() / fmt::format(".{}.new", path.filename().string());
}

std::filesystem::path link_of(const std::filesystem::path& path) {
  return path.parent_path() / fmt::format(".{}.old", path.filename().string());
}

LinkEnd end_of_links(const std::filesystem::path& path) {
  LinkEnd end{path, descriptor_of(path)};
  for (int hops = 0; !end.descriptor && is_link(end.path); ++hops) {
    if (hops == most_links) {
      errno = ELOOP;
      throw OutputError(write_problem(path));
    }
    const std::filesystem::path target = std::filesystem::read_symlink(end.path);
    end.path = target.is_absolute() ? target : end.path.parent_path() / target;
    end.descriptor = descriptor_of(end.path);
  }
  return end;
}

void replace_file(const std::filesystem::path& path, const std::string& text) {
  const LinkEnd end = end_of_links(path);
  std::error_code ignored;
  if (end.descriptor) {
    write_to_descriptor(*end.descriptor, text, path);
  } else if (is_no_regular_file(std::filesystem::status(path, ignored))) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
    if (descriptor < 0) throw OutputError(write_problem(path));
    const DescriptorCloser closer{descriptor};
    write_to_descriptor(descriptor, text, path);
  } else {
    replace_regular_file(end.path, text);
  }
}

void replace_shared_file(const std::filesystem::path& path, const std::string& text) {
  const TemporaryFile temporary(unique_name_beside(path));
  replace_file(temporary.path(), text);
  rename_file(temporary.path(), path);
}

std::filesystem::path unique_name_beside(const std::filesystem::path& path) {
  const auto nanoseconds = std::chrono::system_clock::now().time_since_epoch().count();
  return path.parent_path() / fmt::format(".{}.{}.{}", path.filename().string(), ::getpid(), nanoseconds);
}

void make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!error && std::filesystem::is_directory(directory, error)) return;
  throw OutputError(fmt::format("{}: cannot be used as output directory: {}", directory.string(),
                                error ? error.message() : "not a directory"));
}

std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder, const std::string& extension) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string text_of_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void write_to_descriptor(int descriptor, const std::string& text, const std::filesystem::path& name) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t part = ::write(descriptor, text.data() + written, text.size() - written);
    if (part < 0 && errno != EINTR) throw OutputError(write_problem(name));
    if (part > 0) written += static_cast<std::size_t>(part);
  }
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
  // The link keeps the first file reachable while the other one takes its name; a copy does on file systems without
  // hard links.
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

namespace {

/// Above the three descriptors that programs expect to be open.
constexpr int lowest_descriptor = STDERR_FILENO + 1;

}  // namespace

ResultFile::ResultFile(std::filesystem::path path) : path_(std::move(path)) {
  if (path_ != "-" && end_of_links(path_).descriptor != STDOUT_FILENO) return;
  std::fflush(stdout);
  standard_output_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, lowest_descriptor);
  if (standard_output_ < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) throw OutputError(write_problem(path_));
}

ResultFile::~ResultFile() {
  if (standard_output_ >= 0) ::close(standard_output_);
}

void ResultFile::write(const std::string& text) const {
  if (standard_output_ >= 0) {
    write_to_descriptor(standard_output_, text, path_);
  } else {
    replace_file(path_, text);
  }
}

}  // namespace vehd

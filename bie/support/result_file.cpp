#include "bie/support/result_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "bie/support/file_system.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {
namespace {

/// Not one of the three that programs expect to be open.
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

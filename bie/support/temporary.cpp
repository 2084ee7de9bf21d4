#include "bie/support/temporary.hpp"

#include <cstdlib>

#include "bie/support/file_system.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {

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

#include "bie/pictures/gnuplot.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "bie/support/child_process.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/temporary.hpp"

namespace vehd {
void run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  const TemporaryFile script_file(folder / ".gnuplot-script");
  const TemporaryFile log_file(folder / ".gnuplot-messages");
  replace_file(script_file.path(), script);

  const ChildEnd end = run_child({{"gnuplot", script_file.path().string()}, log_file.path()});
  if (end.start_problem == ENOENT) {
    throw InputError("gnuplot is not installed; on Debian it is the package gnuplot-nox");
  }
  if (end.start_problem != 0) {
    throw InputError(fmt::format("gnuplot cannot be started: {}", std::strerror(end.start_problem)));
  }
  if (end.signal != 0 || end.exit_code != 0) {
    throw InputError(fmt::format("gnuplot failed: {}", text_of_file(log_file.path())));
  }
}

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) quoted += letter == '\'' ? std::string("''") : std::string(1, letter);
  return quoted + "'";
}

std::string gnuplot_literal(const std::string& text) {
  std::string literal;
  for (const char letter : text) literal += letter == '_' ? std::string("\\_") : std::string(1, letter);
  return literal;
}

}  // namespace vehd

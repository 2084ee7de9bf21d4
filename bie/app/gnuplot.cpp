#include "bie/app/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "bie/app/file_system.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

class SpawnActions {
 public:
  SpawnActions() { posix_spawn_file_actions_init(&actions_); }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

void run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  const TemporaryFile script_file(folder / ".gnuplot-script");
  const TemporaryFile log_file(folder / ".gnuplot-messages");
  replace_file(script_file.path(), script);

  SpawnActions actions;
  posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(actions.get(), STDOUT_FILENO, log_file.path().c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0666);
  posix_spawn_file_actions_adddup2(actions.get(), STDOUT_FILENO, STDERR_FILENO);
  std::string program = "gnuplot", file = script_file.path().string();
  char* arguments[] = {program.data(), file.data(), nullptr};
  pid_t process = 0;
  const int problem = posix_spawnp(&process, "gnuplot", actions.get(), nullptr, arguments, environ);
  if (problem == ENOENT) throw InputError("gnuplot is not installed; on Debian it is the package gnuplot-nox");
  if (problem != 0) throw InputError(fmt::format("gnuplot cannot be started: {}", std::strerror(problem)));
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw InputError(fmt::format("gnuplot failed: {}", text_of(log_file.path())));
  }
}

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) quoted += letter == '\'' ? std::string("''") : std::string(1, letter);
  return quoted + "'";
}

}  // namespace vehd

#include "tests/app/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

RunningProgram::RunningProgram(const std::vector<std::string>& command) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output_.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors_.c_str(), O_WRONLY | O_CREAT, 0600);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const int problem = posix_spawnp(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0) throw std::runtime_error("cannot start " + command.front());
}

RunningProgram::~RunningProgram() {
  if (ended()) return;
  send(SIGKILL);
  wait();
}

void RunningProgram::send(int signal) const { ::kill(process_, signal); }

bool RunningProgram::ended() {
  collect(WNOHANG);
  return ended_;
}

ProgramResult RunningProgram::wait() {
  collect(0);
  return {WIFEXITED(status_) ? WEXITSTATUS(status_) : -1, peak_kilobytes_, file_text(output_), file_text(errors_)};
}

void RunningProgram::collect(int options) {
  if (ended_) return;
  rusage usage{};
  ended_ = ::wait4(process_, &status_, options, &usage) == process_;
  peak_kilobytes_ = usage.ru_maxrss;
}

std::vector<std::string> vehd_command(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {VEHD_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

ProgramResult run_command(const std::vector<std::string>& command) { return RunningProgram(command).wait(); }

ProgramResult run_vehd(const std::vector<std::string>& arguments) { return run_command(vehd_command(arguments)); }

std::string python_with(const std::string& modules) {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    if (run_command({"sh", "-c", std::string(python) + " -c 'import " + modules + "'"}).exit_code == 0) return python;
  }
  return {};
}

void copy_some_hard_cases(const std::filesystem::path& tree) {
  const std::filesystem::path folder = "tests/hard/scenes";
  std::filesystem::create_directories(tree / folder);
  for (const char* name : {"contrast_1e8.toml", "thin_middle.toml"}) {
    std::filesystem::copy_file(VEHD_SOURCE_DIR / folder / name, tree / folder / name);
  }
}

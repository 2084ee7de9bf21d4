#include "bie/support/crash_mark.hpp"

#include <fmt/format.h>

#include <array>
#include <climits>
#include <csignal>
#include <cstdio>

namespace vehd {
namespace {

constexpr std::array crash_signals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

/// A handler of signals sees nothing but what stands still. Empty: no mark is wanted.
std::array<char, PATH_MAX> marked_file{};
std::array<std::array<char, PATH_MAX>, crash_signals.size()> marks{};
/// A stack that has run over is no place for a handler.
alignas(16) std::array<char, 1 << 16> handler_stack{};

void put(std::array<char, PATH_MAX>& place, const std::string& text) {
  *fmt::format_to_n(place.data(), place.size() - 1, "{}", text).out = '\0';
}

extern "C" void mark_crash(int signal) {
  for (std::size_t i = 0; i < crash_signals.size(); ++i) {
    if (crash_signals[i] == signal && marked_file[0] != '\0') std::rename(marked_file.data(), marks[i].data());
  }
  // The handler is gone by now: this ends the process.
  std::raise(signal);
}

}  // namespace

CrashMark::CrashMark(const std::filesystem::path& file, const std::filesystem::path& stem) {
  for (std::size_t i = 0; i < crash_signals.size(); ++i)
    put(marks[i], fmt::format("{}{}", stem.string(), crash_signals[i]));
  put(marked_file, file.string());
  stack_t stack{};
  stack.ss_sp = handler_stack.data();
  stack.ss_size = handler_stack.size();
  ::sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_handler = mark_crash;
  action.sa_flags = SA_ONSTACK | SA_NODEFER | static_cast<int>(SA_RESETHAND);
  for (const int signal : crash_signals) ::sigaction(signal, &action, nullptr);
}

CrashMark::~CrashMark() {
  marked_file[0] = '\0';
  for (const int signal : crash_signals) std::signal(signal, SIG_DFL);
}

}  // namespace vehd

#include "bie/runs/sweep/worker_id.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <filesystem>
#include <optional>
#include <sstream>
#include <vector>

#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

std::string plain(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](unsigned char letter) { return std::isalnum(letter) == 0 && letter != '-' && letter != '.'; }, '_');
  return text;
}

/// State and start of a process.
struct ProcessFacts {
  char state = 'X';
  std::uint64_t start = 0;
};

std::optional<ProcessFacts> facts_of(std::int64_t process) {
  const std::string text = text_of_file(fmt::format("/proc/{}/stat", process));
  // The name in brackets may hold anything.
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream rest(text.substr(name_end + 1));
  ProcessFacts facts;
  rest >> facts.state;
  constexpr int fields_between = 18;
  std::string skipped;
  for (int i = 0; i < fields_between; ++i) rest >> skipped;
  rest >> facts.start;
  if (!rest) return std::nullopt;
  return facts;
}

template <typename Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

WorkerId this_worker() {
  WorkerId worker;
  std::array<char, HOST_NAME_MAX + 1> name{};
  ::gethostname(name.data(), name.size() - 1);
  worker.host = plain(std::string(name.data()).substr(0, 64));
  worker.boot = plain(text_of_file("/proc/sys/kernel/random/boot_id").substr(0, 8));
  std::error_code ignored;
  worker.space = plain(std::filesystem::read_symlink("/proc/self/ns/pid", ignored).string());
  worker.process = ::getpid();
  worker.start = facts_of(worker.process).value_or(ProcessFacts{}).start;
  return worker;
}

std::string text_of(const WorkerId& worker) {
  return fmt::format("{}@{}@{}@{}@{}", worker.host, worker.boot, worker.space, worker.process, worker.start);
}

std::optional<WorkerId> worker_of(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('@', start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  WorkerId worker;
  if (parts.size() != 5 || !read_number(parts[3], worker.process) || !read_number(parts[4], worker.start)) return {};
  worker.host = parts[0];
  worker.boot = parts[1];
  worker.space = parts[2];
  return worker;
}

bool is_in_sight(const WorkerId& worker) {
  static const WorkerId here = this_worker();
  return worker.host == here.host && worker.boot == here.boot && worker.space == here.space;
}

bool lives(const WorkerId& worker) {
  const auto facts = facts_of(worker.process);
  return facts && facts->start == worker.start && facts->state != 'Z' && facts->state != 'X';
}

}  // namespace vehd

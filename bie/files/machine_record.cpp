#include "bie/files/machine_record.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "bie/files/versions.hpp"

namespace vehd {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  }
  return "unknown processor";
}

}  // namespace

MachineRecord machine_record() {
  return {processor(),           std::thread::hardware_concurrency(),
          omp_get_max_threads(), library_versions().at("compiler"),
          program_version(),     program_commit()};
}

nlohmann::ordered_json json_of(const MachineRecord& machine) {
  return {{"processor", machine.processor}, {"hardware_threads", machine.hardware_threads},
          {"threads", machine.threads},     {"compiler", machine.compiler},
          {"version", machine.version},     {"commit", machine.commit}};
}

std::string text_of(const MachineRecord& machine) {
  return fmt::format("{}, {} hardware thread{}, {}, vehd {}{}", machine.processor, machine.hardware_threads,
                     machine.hardware_threads == 1 ? "" : "s", machine.compiler, machine.version,
                     machine.commit.empty() ? "" : " at commit " + machine.commit);
}

}  // namespace vehd

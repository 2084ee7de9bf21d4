#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vehd {

/// Machine, compiler and commit of a timing.
struct MachineRecord {
  std::string processor;  ///< as the operating system names it
  unsigned hardware_threads = 0;
  int threads = 0;  ///< that this process uses
  std::string compiler, version, commit;
};
/// That of this process.
MachineRecord machine_record();
/// An object with the members as keys.
nlohmann::ordered_json json_of(const MachineRecord& machine);
/// One line for people.
std::string text_of(const MachineRecord& machine);

}  // namespace vehd

#include "bie/estimate/cost_cache.hpp"

#include <cstdlib>
#include <fstream>

#include "bie/files/machine_record.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {
namespace {

/// As the XDG base directory specification has it: only absolute paths count.
std::filesystem::path user_file() {
  const auto folder = [](const char* variable) -> std::filesystem::path {
    const char* value = std::getenv(variable);
    return value != nullptr && value[0] == '/' ? value : "";
  };
  std::filesystem::path cache = folder("XDG_CACHE_HOME");
  if (cache.empty() && !folder("HOME").empty()) cache = folder("HOME") / ".cache";
  return cache.empty() ? cache : cache / "vehd" / "costs.json";
}

/// What the costs hold for.
nlohmann::json key() {
  const MachineRecord machine = machine_record();
  return {{"version", machine.version},
          {"commit", machine.commit},
          {"compiler", machine.compiler},
          {"processor", machine.processor},
          {"threads", machine.threads}};
}

}  // namespace

CostCache::CostCache() : CostCache(user_file()) {}

CostCache::CostCache(std::filesystem::path file) : file_(std::move(file)) {
  if (!file_.empty()) content_ = nlohmann::json::parse(std::ifstream(file_), nullptr, false);
  const bool ours = content_.is_object() && content_.value("key", nlohmann::json()) == key() &&
                    content_.value("entries", nlohmann::json()).is_object();
  if (!ours) content_ = {{"key", key()}, {"entries", nlohmann::json::object()}};
}

std::optional<nlohmann::json> CostCache::find(const std::string& name, const std::string& what) const {
  const nlohmann::json& entries = content_["entries"];
  if (!entries.contains(name) || !entries[name].is_object() || !entries[name].contains(what)) return std::nullopt;
  return entries[name][what];
}

void CostCache::keep(const std::string& name, const std::string& what, const nlohmann::json& entry) {
  // Entries are small; so many scenes are no longer the same piece of work.
  constexpr std::size_t kMost = 200;
  nlohmann::json& entries = content_["entries"][name];
  if (!entries.is_object() || entries.size() >= kMost) entries = nlohmann::json::object();
  entries[what] = entry;
  if (file_.empty()) return;
  try {
    make_directory(file_.parent_path());
    replace_file(file_, content_.dump(1) + "\n");
  } catch (const OutputError&) {
  }
}

}  // namespace vehd

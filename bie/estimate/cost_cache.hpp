#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace vehd {

/// Costs measured on this machine, kept from call to call in one file. They hold for one program on one machine with
/// one number of threads: a file of another, and one that cannot be understood, counts as none and is replaced by the
/// next entry. A folder that cannot be written is no error; then nothing is kept.
class CostCache {
 public:
  /// The user's: vehd/costs.json in $XDG_CACHE_HOME, or in ~/.cache where that is not set.
  CostCache();
  /// Another file than the user's.
  explicit CostCache(std::filesystem::path file);

  /// Entry of a name, e.g. "cost table" of a scene. @param what  anything that identifies it
  [[nodiscard]] std::optional<nlohmann::json> find(const std::string& name, const std::string& what) const;
  /// Everything is to be measured again.
  void forget() { content_["entries"] = nlohmann::json::object(); }
  /// Keeps an entry, in the file as well, in place of a former one of this name.
  void keep(const std::string& name, const std::string& what, const nlohmann::json& entry);

 private:
  std::filesystem::path file_;  ///< empty: there is no place for one
  nlohmann::json content_;
};

}  // namespace vehd

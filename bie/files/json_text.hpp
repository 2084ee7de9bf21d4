#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vehd {

/// JSON text of a file, one member per line. Bytes that are not UTF-8, as in some file names, become U+FFFD.
inline std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace vehd

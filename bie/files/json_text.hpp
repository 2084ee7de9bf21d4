#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vehd {

/// JSON as a file holds it, one member a line. Bytes that are no UTF-8, as names of files may have, become U+FFFD.
inline std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace vehd

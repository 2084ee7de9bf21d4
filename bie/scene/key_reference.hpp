#pragma once

#include <string>
#include <vector>

namespace vehd {

/// One row of the key table in words.
struct KeyReference {
  std::string table, name, kinds, symbol, type, unit, range, default_value, meaning;
};

/// Every row, in the order of the key table.
std::vector<KeyReference> key_references();

}  // namespace vehd

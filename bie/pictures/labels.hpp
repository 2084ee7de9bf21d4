#pragma once

#include <string>
#include <string_view>

namespace vehd {

/// Words and symbol of a key of a scene, as enhanced text of gnuplot: "permittivity ε" for "electric.permittivity". The
/// key itself if it has none.
std::string key_label(std::string_view key);

/// Likewise of a column of history.csv without its unit; its name without underscores if it has none.
std::string column_title(std::string_view column);

}  // namespace vehd

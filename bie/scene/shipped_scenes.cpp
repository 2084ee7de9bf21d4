#include "bie/scene/shipped_scenes.hpp"

#include <algorithm>

namespace vehd {

std::string title_of(const ShippedScene& scene) {
  std::string comment;
  for (std::string_view rest = scene.text; rest.starts_with('#');) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    const std::size_t start = line.find_first_not_of("# ");
    if (start == std::string_view::npos) break;
    if (!comment.empty()) comment += ' ';
    comment += line.substr(start);
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  }
  return comment.substr(0, comment.find(". "));
}

}  // namespace vehd

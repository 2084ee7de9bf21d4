#include "bie/scene/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace vehd {
namespace {

/// Longer input cannot be close to any key and must not cost quadratic time.
constexpr std::size_t longest_word = 64;

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> distance(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        distance[i][j] = static_cast<int>(i + j);
        continue;
      }
      const int replaced = distance[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      distance[i][j] = std::min({replaced, distance[i - 1][j] + 1, distance[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
      }
    }
  }
  return distance[a.size()][b.size()];
}

std::string_view nearest_name(std::string_view name, const std::vector<std::string_view>& candidates) {
  const auto distance = [word = name.substr(0, longest_word)](std::string_view other) {
    return edit_distance(word, other);
  };
  const auto nearest = std::ranges::min_element(candidates, {}, distance);
  return nearest == candidates.end() ? std::string_view() : *nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates) {
  const std::string_view nearest = nearest_name(name, candidates);
  const int distance = edit_distance(name.substr(0, longest_word), nearest);
  if (!nearest.empty() && distance <= std::max<int>(2, int(nearest.size()) / 2)) {
    return fmt::format("did you mean \"{}\"?", nearest);
  }
  return fmt::format("accepted: {}", fmt::join(candidates, ", "));
}

bool is_one_letter_off(std::string_view name, const std::vector<std::string_view>& candidates) {
  const std::string_view word = name.substr(0, longest_word);
  return std::ranges::any_of(candidates, [&](std::string_view other) { return edit_distance(word, other) == 1; });
}

}  // namespace vehd

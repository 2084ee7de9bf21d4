#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vehd {

/// Number of edits (insert, delete, replace, swap of neighbours) that turn one word into the other.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate with the smallest edit distance from `name`; empty if there are no candidates.
std::string_view nearest_name(std::string_view name, const std::vector<std::string_view>& candidates);

/// Advice for an unknown `name`: `did you mean "x"?` if a candidate is close, otherwise the whole list.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates);

/// Whether the name is one edit away from one of these, see edit_distance.
bool is_one_letter_off(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace vehd

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vehd {

/// Edits (insert, delete, replace, swap of neighbours) that turn one word into the other.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate that the fewest edits make of `name`; empty if there is none.
std::string_view nearest_name(std::string_view name, const std::vector<std::string_view>& candidates);

/// Advice for an unknown `name`: `did you mean "x"?` if a candidate is close, otherwise the whole list.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates);

/// Whether one letter makes the name one of these: another, one more or less, or two that change places.
bool is_one_letter_off(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace vehd

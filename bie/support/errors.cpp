#include "bie/support/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vehd {
namespace {

std::string one_line(std::string text) {
  const auto is_control = [](char letter) { return (letter >= 0 && letter < ' ') || letter == '\x7f'; };
  std::replace_if(text.begin(), text.end(), is_control, ' ');
  return text;
}

}  // namespace

InputError::InputError(std::string message) : std::runtime_error(one_line(std::move(message))) {}

std::string shortened(const std::string& text) {
  constexpr std::size_t longest_shown = 60;
  if (text.size() <= longest_shown) return text;
  return fmt::format("{} ...", text.substr(0, longest_shown));
}

void require_size(const char* what, long actual, long expected) {
  if (actual != expected) {
    throw ShapeError(fmt::format("{} has {} entries but {} are expected", what, actual, expected));
  }
}

}  // namespace vehd

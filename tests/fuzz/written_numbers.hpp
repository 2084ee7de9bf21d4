#pragma once

#include <string>

#include "bie/scene/scene.hpp"

namespace fuzz {

/// Compares every number that stands in the text of a scene with the value that was read of it. Lines "key = value"
/// with numbers, texts with a unit, or lists of both are found by a scanner that knows nothing of the program's parser;
/// lines that it does not understand are left aside.
/// @throws std::logic_error naming the first key whose value is another
void require_written_numbers(const std::string& text, const vehd::Scene& scene);

}  // namespace fuzz

#pragma once

#include <string>

#include "bie/scene/scene.hpp"

namespace fuzz {

/// Compares every number written in the text of a scene with the value read from it. Lines "key = value" with numbers,
/// texts with a unit, or lists of both are found by a scanner that is independent of the program's parser; lines that
/// it cannot read are skipped.
/// @throws std::logic_error naming the first key whose value differs
void require_written_numbers(const std::string& text, const vehd::Scene& scene);

}  // namespace fuzz

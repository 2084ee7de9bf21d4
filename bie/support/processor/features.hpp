#pragma once

namespace vehd::processor {

/// May the other parts of the program use the extension of the instruction set, for each line of features.def?
extern const bool built_for[];

}  // namespace vehd::processor
